# Jumps of energy at length-control events.
width = 1100; height = 860
load folder . "/style.gp"
set multiplot layout 2,2 title "Sums of the jumps of energy at length-control events until 0.65 s"
set logscale xy
set xrange [4:50]
set xtics (5, 10, 20, 30, 40)
set format y "10^{%T}"
set xlabel "elements N"
set key bottom left
letters = "abcd"
panel = 0
do for [what in "kinetic_jumps elastic_jumps"] {
  set ylabel (what eq "kinetic_jumps" ? "Σ |ΔT| (J)" : "Σ |ΔU| (J)")
  do for [kind in kinds] {
    panel = panel + 1
    set title "(" . letters[panel:panel] . ") " . kind . (what eq "kinetic_jumps" ? ", kinetic" : ", elastic")
    plot for [i=1:3] csv("meshes") using "elements":(is(kind, word(transfers, i)) * column(what)) \
           with linespoints linewidth 2 pointtype mark(i) linecolor rgb colour(i) title word(transfers, i)
  }
}
unset multiplot
