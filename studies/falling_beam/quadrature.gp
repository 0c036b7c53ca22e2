# Convergence in the number of Gauss points, beside the error of the mesh itself.
width = 1100; height = 520
load folder . "/style.gp"
set multiplot layout 1,2 title "Error at t = 0.5 s against the number of Gauss points (dotted: error of the mesh itself)"
set logscale y
set xrange [2.5:15.5]
set yrange [1e-9:1]
set format y "10^{%T}"
set xtics 3,1,15
set xlabel "Gauss points an element"
set ylabel "error against 25 points / L"
do for [e in "rancf ancf"] {
  set title panel_title(e)
  set key top right
  plot csv("quadrature") using "points":e."_n10" with linespoints linewidth 2 pointtype 7 pointsize 0.8 linecolor rgb "#4292c6" title "N = 10", \
       "" using "points":e."_n20" with linespoints linewidth 2 pointtype 5 pointsize 0.8 linecolor rgb "#a63603" title "N = 20", \
       "" using "points":e."_n10_mesh" with lines linewidth 1 dashtype 3 linecolor rgb "#4292c6", \
       "" using "points":e."_n20_mesh" with lines linewidth 1 dashtype 3 linecolor rgb "#a63603"
}
unset multiplot
