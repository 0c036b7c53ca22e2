# Largest errors against the number of elements, with the paper's.
width = 1100; height = 480
load folder . "/../moving_string/style.gp"
set multiplot layout 1,2 title "Largest error of the deflections over U_s, against the closed form"
of(s, q) = strcol("set") eq s && strcol("quantity") eq q ? 1 : NaN
set logscale xy
set format y "10^{%T}"
set xtics (4, 8, 16, 32)
set xrange [3.5:40]
set yrange [5e-7:0.05]
set xlabel "elements N"
set ylabel "max |ΔU| / U_s"
set key bottom left font ",12"
quantities = "load_U1 load_U2 middle_U1 middle_U2"
titles = "'loaded point, U_1' 'loaded point, U_2' 'middle, U_1' 'middle, U_2'"
colours = "#08519c #6baed6 #a63603 #fd8d3c"
do for [s in "slow fast"] {
  set title s eq "slow" ? "(a) a = 0.5, k_{ω} = 1" : "(b) a = 1.5, k_{ω} = 0.5"
  plot for [i=1:4] csv("errors") using "elements":(of(s, word(quantities, i)) * abs(column("error"))) \
         with linespoints linewidth 2 pointtype 7 linecolor rgb word(colours, i) title word(titles, i), \
       for [i=1:4] csv("errors") using "elements":(of(s, word(quantities, i)) * abs(column("paper_error"))) \
         with points pointtype 2 pointsize 1.4 linewidth 2 linecolor rgb word(colours, i) title i == 1 ? "the paper's" : "", \
       1.2*x**-3 with lines dashtype 2 linecolor rgb grey title "slope 3"
}
unset multiplot
