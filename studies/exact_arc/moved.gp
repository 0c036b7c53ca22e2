# Distance from the circle while the joint between two arcs slides along it.
width = 1300; height = 470
load folder . "/../style.gp"
angles = "20 40 60"
set multiplot layout 1,3 title "Two arc elements, the joint between them moved along the circle" margins 0.08,0.8,0.15,0.82 spacing 0.06,0.1
set logscale y
set format y "10^{%T}"
set yrange [1e-17:1]
set xlabel "joint position / element length"
unset key
do for [i=1:3] {
  set title sprintf("(%s) elements of %s°", word("a b c", i), word(angles, i))
  if (i == 3) { set key at screen 0.995,0.6 top right noautotitle } else { unset key }
  if (i == 1) { set ylabel "max ||{/:Bold r}| - R| / R" } else { unset ylabel }
  this(value) = column("angle") == real(word(angles, i)) ? column(value) + 1e-17 : NaN
  plot csv("moved") using "share":(this("frozen")) with linespoints linewidth 2 pointtype 5 linecolor rgb "#a63603" title "frozen weights", \
       "" using "share":(this("polynomial")) with linespoints linewidth 2 pointtype 6 linecolor rgb "#fd8d3c" title "unit weights", \
       "" using "share":(this("transported")) with linespoints linewidth 2 pointtype 7 linecolor rgb "#08519c" title "transported weights"
}
unset multiplot
