# Semicircle: distance from the circle and spurious energy against the number of elements.
width = 1100; height = 470
load folder . "/../style.gp"
set multiplot layout 1,2 title "Semicircle of radius 2 m" margins 0.09,0.97,0.14,0.84 spacing 0.12,0.1
set logscale xy
set format y "10^{%T}"
set xlabel "elements N"
set xrange [2.5:80]
set xtics (3,5,10,20,40,64)
set title "(a) distance from the circle"
set ylabel "max ||{/:Bold r}| - R| / R"
set key at graph 0.97,0.5 right
set yrange [1e-17:1]
plot csv("meshes") using "elements":"polynomial_distance" with linespoints linewidth 2 pointtype 6 linecolor rgb "#a63603" title "ALE-ANCF", \
     csv("meshes") using "elements":(column("rational_distance") + 1e-17) with linespoints linewidth 2 pointtype 7 linecolor rgb "#08519c" title "ALE-RANCF", \
     0.05*x**-4 with lines linecolor rgb "#888888" dashtype 2 title "slope -4", \
     1.42e-14 with lines linecolor rgb "#888888" dashtype 3 title "64 ε"
set title "(b) axial energy measured from a straight beam"
set ylabel "axial energy (J)"
set autoscale y
set key default
set key noautotitle top right
plot csv("meshes") using "elements":"rational_energy" with linespoints linewidth 2 pointtype 7 linecolor rgb "#08519c" title "ALE-RANCF", \
     csv("meshes") using "elements":"polynomial_energy" with linespoints linewidth 2 pointtype 6 linecolor rgb "#a63603" title "ALE-ANCF", \
     1.5e4*x**-4 with lines linecolor rgb "#888888" dashtype 2 title "slope -4"
unset multiplot
