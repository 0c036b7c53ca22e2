# Differences between program and judge in time, a panel a case, with the sum of both uncertainties. Needs `cases`.
width = 1400; height = 900
load folder . "/style.gp"
set multiplot layout 3,4 title "Largest difference of positions over the length: program and judge" margins 0.06,0.98,0.07,0.9 spacing 0.05,0.115
set logscale y
set format y "10^{%T}"
set yrange [1e-13:1]
set ytics 1e4  # eleven panels: each tic weighs
unset mytics
set xlabel "t [s]" offset 0,0.8
set xrange [0:*]
# a case by its words, for an underscore lowers what follows
spoken(c) = (i_ = strstrt(c, "_")) > 0 ? c[1:i_-1] . " " . spoken(c[i_+1:*]) : c
of(c, v) = strcol("case") eq c ? column(v) : NaN
do for [i=1:words(cases)] {
  c = word(cases, i)
  set title spoken(c)
  dt = c eq "winch" ? 0.5 : 0.1
  set xtics dt
  if (i == 1) { set key bottom right samplen 1.5 } else { unset key }
  plot csv("times") using "t":(of(c, "difference")) with linespoints pointtype 7 pointsize 0.6 linewidth 1.7 linecolor rgb "#d62728" title "difference", \
       csv("times") using "t":(of(c, "uncertainties")) with lines linewidth 1.7 linecolor rgb "#08306b" title "both uncertainties", \
       csv("times") using "t":(of(c, "judge_uncertainty")) with lines dashtype 2 linewidth 1.5 linecolor rgb "#888888" title "of these the judge's"
}
unset multiplot
