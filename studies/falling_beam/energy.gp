# Total energy against time for both formulations, with and without the jumps of length control.
width = 1100; height = 780
load folder . "/style.gp"
set multiplot layout 2,2 title "Total energy until the mass leaves: paper\047s virtual work (dashed), variational equations (solid)"
set xrange [0:0.75]
set xtics 0.1
set xlabel "t (s)"
do for [kind in "total kept"] {
  do for [e in "rancf ancf"] {
    set title panel_title(e) . (kind eq "kept" ? ", without the jumps of length control" : ", total")
    if (kind eq "kept" && e eq "rancf") { set key bottom left title "N" } else { set key top left title "N" }
    set ylabel "energy (J)"
    plot for [n in meshes] csv("energy_histories") using "t":kind."_paper_".e."_n".n with lines linewidth 2 dashtype 2 \
           linecolor rgb mesh_colour(int(n)), \
         for [n in meshes] csv("energy_histories") using "t":kind."_variational_".e."_n".n with lines linewidth 2 \
           linecolor rgb mesh_colour(int(n)) title n
  }
}
unset multiplot
