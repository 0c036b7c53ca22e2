# Temporal error of generalized-alpha.
width = 1100; height = 470
load folder . "/style.gp"
set multiplot layout 1,2 title "Generalized-alpha through the whip to 0.65 s: error against the same mesh converged in time"
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set xrange [1e-4:1.3e-3]
set xlabel "step (s)"
set ylabel "max(|Δx_i|, |Δ{/:Bold r}_{end}|, |Δ{/:Bold r}_{mass}|) / L"
set key bottom right
do for [kind in kinds] {
  set title (kind eq "ALE-RANCF" ? "(a) " : "(b) ") . kind
  plot for [i=1:3] csv("temporal") using "step":(is(kind, word(transfers, i)) * column("error_late")) \
         with linespoints linewidth 2 pointtype mark(i) linecolor rgb colour(i) title word(transfers, i), \
       8e2*x**2 with lines linecolor rgb "#888888" dashtype 2 title "slope 2"
}
unset multiplot
