# Path of a weight that a winch hoists while it swings.
width = 560; height = 680
load folder . "/../moving_string/style.gp"
set title "A weight that a winch hoists while it swings"
set xlabel "X (m)"
set ylabel "Y (m)"
set size ratio -1
set xrange [-0.8:0.8]
set yrange [-2.1:0.1]
set key outside bottom center
set xtics 0.4
plot csv("winch") using "X":"Y" with lines linewidth 2 linecolor rgb blue title "10 elements ALE-ANCF", \
     csv("winch_pendulum") using "X":"Y" with points pointtype 6 pointsize 1.3 linecolor rgb red title "pendulum of given length", \
     "+" using (0):(0) every ::0::0 with points pointtype 7 pointsize 1.5 linecolor rgb grey title "winch"
