# Figure 15: the initial configuration, and an arc element AB with the point C in which its end tangents meet.
width = 900; height = 560
load folder . "/style.gp"
set title "Initial configuration of Example 3: R = 2 m, a mass of 0.8 kg at 1/16 of the beam"
set size ratio -1
set xrange [-2.5:2.5]
set yrange [-2.5:0.45]
set xlabel "X (m)"
set ylabel "Y (m)"
set key at 0.9,-0.15 right top vertical
R = 2.0; a = 292.5*pi/180; b = 315*pi/180; m = (a + b)/2; c = R/cos((b - a)/2)
set label 1 "A" at R*cos(a), R*sin(a) offset -0.8,-0.9 center
set label 2 "B" at R*cos(b), R*sin(b) offset 1.4,-0.1 center
set label 3 "C" at c*cos(m), c*sin(m) offset 1.0,-0.8 center
set label 4 "g" at 0, 0.12 offset 1.2,0
set arrow 1 from 0, 0.3 to 0, -0.05 linewidth 2 linecolor rgb "#222222"
set label 5 "w_1 = w_2 = (1 + 2 cos(θ/2))/3 for an arc of the angle θ" at 0, -1.45 center
set print $control
print sprintf("%g,%g", R*cos(a), R*sin(a))
print sprintf("%g,%g", c*cos(m), c*sin(m))
print sprintf("%g,%g", R*cos(b), R*sin(b))
set print $pins
print "-2,0"
print "2,0"
unset print
set samples 100
set trange [a:b]
start(name) = strcol("run") eq "coarsest" && column("t") == 0
plot csv("printed_shapes") using "printed_0_x":"printed_0_y" with lines linewidth 2.5 linecolor rgb "#08306b" title "beam", \
     csv("printed_nodes") using (start(0) && column("joint") == 0 ? column("x") : NaN):"y" with points pointtype 7 pointsize 0.7 linecolor rgb "#08306b" title "nodes, N = 8", \
     "" using (start(0) && column("joint") == 1 ? column("x") : NaN):"y" with points pointtype 7 pointsize 2 linecolor rgb "#a63603" title "sliding mass", \
     [a:b] "+" using (R*cos($1)):(R*sin($1)) with lines linewidth 5 linecolor rgb "#fd8d3c" title "an arc element AB, θ = 22.5°", \
     $control using 1:2 with linespoints linewidth 1.5 dashtype 2 pointtype 6 linecolor rgb "#444444" title "its end tangents, to C", \
     $pins using 1:2 with points pointtype 9 pointsize 1.7 linecolor rgb "#444444" title "pins"
