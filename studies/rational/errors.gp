# Error against the number of elements, and against work, of both elements.
width = 1250; height = 860
load folder . "/style.gp"
kinds = "polynomial frozen transported"
names = "'ALE-ANCF' 'ALE-RANCF, frozen' 'ALE-RANCF, transported'"
problems = "bead falling suspended"
titles = "'bead on a stiff semicircle' 'falling beam' 'suspended beam'"
is(p, k) = (strcol("problem") eq p && strcol("kind") eq k) ? 1 : NaN
set multiplot layout 2,3 title "When does the rational element pay?"
set logscale xy
set format y "10^{%T}"
panel = 0
do for [row=1:2] {
  set xlabel row == 1 ? "elements N" : "work: evaluations × N"
  if (row == 2) { set format x "10^{%T}"; set xtics auto }
  do for [j=1:3] {
    panel = panel + 1
    p = word(problems, j)
    if (row == 1) {
      if (j == 1) { set xtics (4, 6, 8, 12, 16, 24, 32); set xrange [3.5:38] }
      if (j == 2) { set xtics (5, 10, 20, 40); set xrange [4.4:46] }
      if (j == 3) { set xtics (3, 6, 12, 24, 48); set xrange [2.6:56] }
    } else {
      if (j == 1) { set xrange [4e4:2e6] }
      if (j == 2) { set xrange [1e5:4e7] }
      if (j == 3) { set xrange [3e4:2e8] }
    }
    set ylabel j == 1 ? "largest error / L" : ""
    if (panel == 2) { set key bottom left Left reverse samplen 1.5 } else { unset key }
    set title word("(a) (b) (c) (d) (e) (f)", panel) . " " . word(titles, j)
    plot for [i=1:3] csv("meshes") using (row == 1 ? column("elements") : column("work")):(is(p, word(kinds, i))*column("error")) \
           with linespoints linewidth 2 pointtype mark(i) linecolor rgb colour(i) title word(names, i)
  }
}
unset multiplot
