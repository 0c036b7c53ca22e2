# Rods in inclined sleeves, each balanced by its length outside.
width = 800; height = 560
load folder . "/../moving_string/style.gp"
set title "Rod in a frictionless sleeve, in balance under a weight at its end"
set xlabel "x (m)"
set ylabel "y (m)"
set size ratio -1
set xrange [-0.08:1.6]
set yrange [-0.1:0.95]
set key outside right title "inclination"
angles = "15 30 45 60 75"
colours = "#08306b #2171b5 #6baed6 #238b45 #a63603"
of(angle, x) = column("degrees") == angle ? x : NaN
do for [i=1:5] {
  a = word(angles, i) * pi / 180
  set arrow i from -0.07 * cos(a), -0.07 * sin(a) to 0, 0 nohead linewidth 5 linecolor rgb word(colours, i)
}
plot for [i=1:5] csv("sleeve_shapes") using (of(word(angles, i) + 0, column("x"))):(column("y")) with lines linewidth 2 linecolor rgb word(colours, i) title word(angles, i) . " degrees", \
     csv("sleeve_tips") using "tip_x":"tip_y" with points pointtype 7 pointsize 0.9 linecolor rgb "#222222" title "weight"
