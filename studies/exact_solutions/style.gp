# What both figures share. Needs `output` and `folder`; `width` and `height` in pixels.
load folder . "/../moving_string/style.gp"
set logscale xy
set format y "10^{%T}"
set key samplen 1.5 spacing 1.1
set ylabel "error"
colours = "#08306b #2171b5 #6baed6 #238b45 #a63603 #fd8d3c #807dba #666666"
colour(i) = word(colours, i)
# a case of a family, by what is measured of it
of(family, case, what) = strcol("family") eq family && strcol("case") eq case && strcol("of") eq what ? column("error") : NaN
# which of the pairs of words are there, `present` having them all
drawn(families, cases) = (some = "", sum [i=1:words(families)] (some = strstrt(present, "|" . word(families, i) . "|" . word(cases, i) . "|") > 0 ? some . " " . i : some, 0), some)
