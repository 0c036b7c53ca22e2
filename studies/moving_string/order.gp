# Error of the first frequency against the number of elements.
width = 700; height = 480
load folder . "/style.gp"
of(model) = strcol("model") eq model ? 1 : NaN
set title "First frequency at v = 40 m/s against the exact one of the linear theory"
set logscale xy
set format y "10^{%T}"
set xtics (4, 6, 8, 12, 16)
set xrange [2.7:18]
set xlabel "elements N"
set ylabel "|f_1 - f_{1,exact}| (Hz)"
set key top right
plot csv("order") using "elements":(of("beam") * column("error")) with linespoints linewidth 2 pointtype 7 linecolor rgb blue title "beam", \
     csv("order") using "elements":(of("string") * column("error")) with linespoints linewidth 2 pointtype 5 linecolor rgb red title "string", \
     6*x**-4 with lines dashtype 2 linecolor rgb grey title "slope 4", \
     5.5*x**-6 with lines dashtype 3 linecolor rgb grey title "slope 6"
