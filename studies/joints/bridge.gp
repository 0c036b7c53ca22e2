# A mass that is driven over a bridge.
width = 800; height = 460
load folder . "/../moving_string/style.gp"
set title "Under a mass that is driven over a bridge at 30 m/s"
set xlabel "t (s)"
set ylabel "deflection under the mass / static deflection"
set xrange [0:0.6]
set key outside bottom center horizontal
plot csv("bridge") using "t":"deflection" with lines linewidth 2 linecolor rgb blue title "32 elements ALE-ANCF", \
     csv("bridge_modes") using "t":"deflection" with points pointtype 6 pointsize 1.3 linecolor rgb red title "modes of the linear beam"
