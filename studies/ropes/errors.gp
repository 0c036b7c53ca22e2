# Errors of ropes: angular momentum of a deployed tether against the step, pulls of hanging ropes against the mesh.
width = 1400; height = 500
load folder . "/style.gp"
set multiplot layout 1,3 title "Errors of ropes, relative" margins 0.08,0.98,0.14,0.81 spacing 0.08,0.1
set logscale xy
set format y "10^{%T}"
set key top left Left reverse samplen 1.5
set title "(a) tether deployed from a hub that spins"
set xlabel "step [ms]"
set ylabel "change of the angular momentum [-]"
set xtics (0.5, 1, 2, 4, 8)
set xrange [0.4:10]
plot csv("tether") using (1000*column("step")):"change" with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5" title "generalized-alpha", \
     6e-7*x**2 with lines dashtype 2 linecolor rgb "#888888" title "order 2"
set key top right noreverse
set title "(b) rope between two supports"
set xlabel "elements"
set ylabel "error of the pull [-]"
set xtics (4, 8, 16, 32, 64)
set xrange [3.5:75]
plot csv("hanging") using "elements":"error" with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5" title "statics", \
     0.01*x**(-4) with lines dashtype 2 linecolor rgb "#888888" title "order 4"
set title "(c) chain from the ground to a fairlead"
set xtics (15, 30, 60, 120, 240)
set xrange [13:280]
plot csv("mooring") using "elements":"error" with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#2171b5" title "statics", \
     3*x**(-2) with lines dashtype 2 linecolor rgb "#888888" title "order 2"
unset multiplot
