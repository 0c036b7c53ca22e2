# Errors against the number of elements.
width = 800; height = 520
load folder . "/../moving_string/style.gp"
set title "Equilibria and natural frequencies: error against elements"
set logscale xy
set format y "10^{%T}"
set xlabel "elements"
set ylabel "error"
set xtics (4, 8, 16, 32, 64)
set xrange [3.5:75]
set yrange [1e-9:1e-1]
set key outside right
names = "roll_up elastica catenary arch pinned clamped free"
colours = "#08306b #2171b5 #6baed6 #238b45 #a63603 #fd8d3c #807dba"
is(name, x) = strcol("case") eq name ? x : NaN
plot for [i=1:7] csv("errors") using "elements":(is(word(names, i), column("error"))) with linespoints pointtype 7 linecolor rgb word(colours, i) title word(names, i) noenhanced, \
     2e1 * x**-4 with lines dashtype 2 linecolor rgb grey title "order 4"
