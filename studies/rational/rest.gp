# How elements at rest follow their axis: across it and along it.
width = 1250; height = 860
load folder . "/style.gp"
kinds = "polynomial even exact"
names = "'ALE-ANCF' 'ALE-RANCF, even' 'ALE-RANCF, exact'"
curves = "'circle' 'quarter of an ellipse' 'parabola'"
is(c, k) = (strcol("curve") eq c && strcol("kind") eq k) ? 1 : NaN
set multiplot layout 2,3 title "Elements at rest: distance from the axis, and how evenly they run along it"
set logscale xy
set format y "10^{%T}"
set xtics (4, 8, 16, 32, 64)
set xrange [3.5:73]
set xlabel "elements N"
do for [row=1:2] {
  set yrange [(row == 1 ? 1e-17 : 1e-9):(row == 1 ? 1e-2 : 1e1)]
  do for [j=1:3] {
    set ylabel j == 1 ? (row == 1 ? "distance / L" : "max ||{/:Bold r}_x| - 1|") : ""
    if (row == 2 && j == 1) { set key top right } else { unset key }
    set title word("(a) (b) (c) (d) (e) (f)", 3*(row - 1) + j) . " " . word(curves, j)
    plot for [i=1:3] csv("rest") using "elements":(is(word(curves, j), word(kinds, i))*(row == 1 ? column("across") : column("uneven"))) \
           with linespoints linewidth 2 pointtype mark(i) linecolor rgb colour(i) title word(names, i)
  }
}
unset multiplot
