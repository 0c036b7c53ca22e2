# Figure 10: Y of the beam's right end.
width = 1100; height = 470
load folder . "/style.gp"
set multiplot layout 1,2 title "Height of the beam\047s end\n{/*0.85 " . setting . "}"
set xrange [0:0.75]
set yrange [-1.05:0.1]
set xtics 0.1
set xlabel "t (s)"
set ylabel "Y of the end (m)"
do for [e in "rancf ancf"] {
  set title panel_title(e)
  set key top right title "N"
  plot for [n in meshes] csv("histories_" . sweep) using "t":"end_y_".e."_n".n with lines linewidth 2 \
         dashtype mesh_dash(int(n)) linecolor rgb mesh_colour(int(n)) title n
}
unset multiplot
