# Error against the number of elements.
width = 1100; height = 860
load folder . "/style.gp"
set multiplot layout 2,2 title "Error against the converged beam, by the velocities that length control gives the new mesh"
set logscale xy
set xrange [4:50]
set xtics (5, 10, 20, 30, 40)
set format y "10^{%T}"
set xlabel "elements N"
set ylabel "max(|Δx_i|, |Δ{/:Bold r}_{end}|, |Δ{/:Bold r}_{mass}|) / L"
set key bottom left
panel = 0
do for [t in "early late"] {
  do for [kind in kinds] {
    panel = panel + 1
    set title word("(a) (b) (c) (d)", panel) . " " . kind . (t eq "early" ? ", 0.5 s" : ", 0.65 s, after the whip")
    plot for [i=1:3] csv("meshes") using "elements":(is(kind, word(transfers, i)) * column("error_".t)) \
           with linespoints linewidth 2 pointtype mark(i) linecolor rgb colour(i) title word(transfers, i)
  }
}
unset multiplot
