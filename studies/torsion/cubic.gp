# Linear and cubic angles.
width = 800; height = 500
load folder . "/../moving_string/style.gp"
set title "Torsion of a shaft fixed at one end: what cubic angles gain"
set logscale xy
set format y "10^{%T}"
set xlabel "unknowns"
set ylabel "f_h/f - 1 (%)"
set xrange [1.8:25]
set xtics (2, 3, 5, 10, 20)
set yrange [1e-9:100]
set key outside right title "mode"
colours = "#08306b #2171b5 #6baed6 #fd8d3c #a63603"
of(mode) = column("mode") == mode ? 1 : NaN
plot for [i=1:5] csv("table3") using (column("elements") + 1):(of(i) * column("error")) with linespoints dashtype 2 pointtype 6 linecolor rgb word(colours, i) title "".i.", linear", \
     for [i=1:5] csv("cubic") using "unknowns":(of(i) * column("error")) with linespoints linewidth 2 pointtype 7 linecolor rgb word(colours, i) title "".i.", cubic"
