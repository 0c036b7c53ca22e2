# Figure 16: configurations, beam length, trajectory of the sliding node, energies.
width = 1200; height = 980
load folder . "/style.gp"
set multiplot layout 2,2 title "Mass sliding on a suspended semicircular beam\n{/*0.85 " . setting . "}" margins 0.07,0.97,0.07,0.89 spacing 0.09,0.14

set title "(a) configurations, N = " . finest
set size ratio -1
set xrange [-2.2:2.2]
set yrange [-2.6:0.9]
set xlabel "X (m)"
set ylabel "Y (m)"
set palette defined (0 "#08306b", 0.25 "#2171b5", 0.5 "#6baed6", 0.75 "#fdae6b", 1 "#a63603")
unset colorbox
last = real(word(times, words(times)))
set key top center horizontal maxrows 2 title "t (s)" samplen 1 width -1
plot for [t in times] csv(shape) using run."_".t."_x":run."_".t."_y" with lines linewidth 2 linecolor palette frac (real(t)/last) title t, \
     csv(node) using (strcol("run") eq run && column("joint") == 1 ? column("x") : NaN):"y":(column("t")/last) with points pointtype 7 pointsize 1.1 linecolor palette
set size noratio
set autoscale
set key title ""
set key vertical maxrows 6

set title "(b) beam length"
set xlabel "t (s)"
set ylabel "length (m)"
set format y "%.2f"
set key top left vertical
# Coarse meshes have spikes when elements merge: all of them are in the frame, and the finest mesh is drawn last.
set xrange [0:real(last)]
set offsets 0, 0, graph 0.05, graph 0.02
plot for [n in meshes] csv(history) using "t":"beam_length_n".n with lines linewidth 1.6 linecolor rgb mesh_colour(int(n)) title "N = ".n
set format y
set autoscale y
set offsets 0, 0, 0, 0
set autoscale x

set key vertical
set title "(c) trajectory of the sliding node"
set xlabel "X (m)"
set ylabel "Y (m)"
set key top center
plot for [n in meshes] csv(history) using "mass_x_n".n:"mass_y_n".n with lines linewidth 1.6 linecolor rgb mesh_colour(int(n)) title "N = ".n

set title "(d) energies, N = " . finest
set xlabel "t (s)"
set ylabel "energy less its initial value (J)"
set key top center horizontal maxrows 2
stats csv(history) using "strain_n".finest every ::0::0 nooutput
strain = STATS_mean
stats csv(history) using "gravity_n".finest every ::0::0 nooutput
gravity = STATS_mean
stats csv(history) using "total_n".finest every ::0::0 nooutput
total = STATS_mean
set yrange [-40:60]  # room for the key
plot csv(history) using "t":"kinetic_n".finest with lines linewidth 2 linecolor rgb "#a63603" title "kinetic", \
     "" using "t":(column("strain_n".finest) - strain) with lines linewidth 2 linecolor rgb "#4292c6" title "strain", \
     "" using "t":(column("gravity_n".finest) - gravity) with lines linewidth 2 linecolor rgb "#08306b" title "gravity", \
     "" using "t":(column("total_n".finest) - total) with lines linewidth 2 linecolor rgb "#222222" dashtype 2 title "total"
unset multiplot
