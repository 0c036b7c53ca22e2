# Error at 0.5 s against the number of elements.
width = 1100; height = 520
load folder . "/style.gp"
set multiplot layout 1,2 title "Error at t = 0.5 s against the number of elements"
set logscale xy
set xrange [4:70]
set yrange [1e-5:1]
set format y "10^{%T}"
set xtics (5, 10, 20, 30, 40)
set xlabel "elements N"
set ylabel "max(|Δx_i|, |Δ{/:Bold r}_{end}|, |Δ{/:Bold r}_{mass}|) / L"
dash(c) = c eq "full" ? 2 : 1
do for [e in "rancf ancf"] {
  set title panel_title(e)
  set key top right samplen 2
  set label 1 "slope 2" at 41,0.02/16. textcolor rgb "#888888"
  set label 2 "slope 4" at 41,0.006/256. textcolor rgb "#888888"
  plot for [c in clamps] csv("errors") using "elements":e."_variational_".c with linespoints linewidth 2 \
         pointtype (c eq "full" ? 6 : 7) pointsize 0.8 dashtype dash(c) \
         linecolor rgb (c eq "full" ? "#4292c6" : "#08519c") title "variational, " . c . " clamp", \
       for [c in clamps] csv("errors") using "elements":e."_paper_".c with linespoints linewidth 2 \
         pointtype (c eq "full" ? 4 : 5) pointsize 0.8 dashtype dash(c) \
         linecolor rgb (c eq "full" ? "#fd8d3c" : "#a63603") title "paper\047s setting, " . c . " clamp", \
       [10:40] 0.02*(10./x)**2 with lines linewidth 1 linecolor rgb "#888888", \
       [10:40] 0.006*(10./x)**4 with lines linewidth 1 linecolor rgb "#888888"
}
unset multiplot
