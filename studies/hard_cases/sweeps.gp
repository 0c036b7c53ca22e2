# What makes a case hard against condition number, temporal error and energy error, a panel each.
set terminal svg size 1200,440 font "sans-serif,13" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set logscale xy
set format xy "10^{%T}"
csv = data . "cases.csv"
array groups[4] = ["mass_ratio", "weights", "damping", "speed"]
array titles[4] = ["sliding mass / beam's mass", "inner weights / outer ones", "damping time c [s]", "sliding speed / wave speed"]
array colours[4] = ["#08519c", "#1b7837", "#d94801", "#6a3d9a"]
array marks[4] = [7, 5, 9, 11]
array columns[3] = ["condition", "error", "energy_error"]
array labels[3] = ["condition number of the scaled mass matrix", "position error at the end / L", "largest energy error / max T"]
array panels[3] = ["(a) mass matrix", "(b) position", "(c) energy"]
array lowest[3] = [10, 3e-8, 1e-9]
set xlabel "value of the sweep"
set multiplot layout 1,3 title "Hard cases: what grows with what makes them hard" margins 0.06,0.78,0.14,0.8 spacing 0.07
do for [p = 1:3] {
  set title panels[p]
  set ylabel labels[p]
  set yrange [lowest[p]:*]
  if (p == 3) { set key at screen 0.998,0.6 right center noautotitle samplen 2 } else { set key off }
  plot for [g = 1:4] csv using (strcol("case") eq groups[g] && column("value") > 0 ? column("value") : NaN):columns[p] \
         with linespoints linewidth 1.5 pointtype marks[g] pointsize 0.8 linecolor rgb colours[g] title titles[g]
}
unset multiplot
