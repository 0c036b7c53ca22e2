# Errors of equilibria against the number of elements.
width = 800; height = 520
load folder . "/../moving_string/style.gp"
set title "Equilibria in a sleeve and through a ring: error against elements"
set logscale xy
set format y "10^{%T}"
set xlabel "elements"
set ylabel "error"
set xtics (10, 20, 40, 80, 160)
set xrange [9:180]
set key outside right
names = "sleeve_15 sleeve_30 sleeve_45 sleeve_60 sleeve_75 ring_place ring_forces"
titles = "'sleeve, 15 degrees' 'sleeve, 30 degrees' 'sleeve, 45 degrees' 'sleeve, 60 degrees' 'sleeve, 75 degrees' 'ring, place' 'ring, end forces'"
colours = "#08306b #2171b5 #6baed6 #238b45 #a63603 #fd8d3c #807dba"
is(name, x) = strcol("case") eq name ? x : NaN
plot for [i=1:7] csv("errors") using "level":(is(word(names, i), column("error"))) with linespoints pointtype 7 linecolor rgb word(colours, i) title word(titles, i) noenhanced, \
     1e0 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
