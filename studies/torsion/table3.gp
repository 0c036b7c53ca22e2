# Table 3 of the paper as a figure.
width = 800; height = 500
load folder . "/../moving_string/style.gp"
set title "Torsion of a shaft fixed at one end and free at the other: error of the frequencies"
set logscale y
set xlabel "elements N"
set ylabel "f_h/f - 1 (%)"
set xrange [0.5:10.5]
set xtics 1
set yrange [0.08:40]
set key outside right title "mode"
colours = "#08306b #2171b5 #6baed6 #fd8d3c #a63603"
of(mode) = column("mode") == mode ? 1 : NaN
plot for [i=1:5] csv("table3") using "elements":(of(i) * column("exact_error")) with lines linewidth 2 linecolor rgb word(colours, i), \
     for [i=1:5] csv("table3") using "elements":(of(i) * column("error")) with points pointtype 7 linecolor rgb word(colours, i) title "".i, \
     1 with lines dashtype 2 linecolor rgb grey title "1 %"
