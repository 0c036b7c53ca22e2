# The load of a shallow arch, and where it is stable.
width = 800; height = 480
load folder . "/../moving_string/style.gp"
set title "Shallow arch: equilibria through two limit points"
set xlabel "deflection of the middle (m)"
set ylabel "load (N)"
set xrange [0:0.1]
set yrange [-1:9]
set xzeroaxis linewidth 0.8 linecolor rgb "#444444"
set key top left
set label 1 "3.92 N" at 0.0226,4.4 center textcolor rgb grey
set label 2 "-0.11 N" at 0.064,-0.5 center textcolor rgb grey
is(x) = column("falls") == 0 ? x : NaN
not(x) = column("falls") > 0 ? x : NaN
plot csv("arch") using "deflection":(is(column("load"))) with points pointtype 7 pointsize 0.35 linecolor rgb blue title "stable", \
     csv("arch") using "deflection":(not(column("load"))) with points pointtype 7 pointsize 0.35 linecolor rgb red title "not stable"
