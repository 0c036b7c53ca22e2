# Height of a load on a lead screw, by the torque that turns it.
width = 760; height = 520
load folder . "/../moving_string/style.gp"
set title "A load on a lead screw, by the torque over that of balance"
set xlabel "t (s)"
set ylabel "height of the load (m)"
set xrange [0:1]
set yrange [0:0.85]
set key outside bottom center horizontal maxcols 3
plot for [i=1:4] csv("screw") using "t":(abs(column("torque") - real(word("1.2 1.06 1 0.96", i))) < 1e-6 ? column("height") : NaN) \
       with lines linewidth 2 linetype i title "torque ".word("1.2 1.06 1 0.96", i), \
     csv("screw_rigid") using "t":"height" with points pointtype 6 pointsize 1 linecolor rgb grey title "rigid screw"
