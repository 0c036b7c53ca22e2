# Figure 11: paths of the sliding node while it is on the beam.
width = 1100; height = 560
load folder . "/style.gp"
set multiplot layout 1,2 title "Trajectories of the sliding node\n{/*0.85 " . setting . "}"
set size ratio -1
set xrange [-0.65:0.4]
set yrange [-0.9:0.05]
set xtics 0.2
set ytics 0.2
set xlabel "X (m)"
set ylabel "Y (m)"
do for [e in "rancf ancf"] {
  set title panel_title(e)
  set key top left title "N"
  plot for [n in meshes] csv("histories_" . sweep) using "joint_x_".e."_n".n:"joint_y_".e."_n".n with lines linewidth 2 \
         dashtype mesh_dash(int(n)) linecolor rgb mesh_colour(int(n)) title n
}
unset multiplot
