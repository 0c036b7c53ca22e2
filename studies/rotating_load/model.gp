# What rotary inertia and spin change, against the thickness of the shaft.
width = 800; height = 500
load folder . "/../moving_string/style.gp"
set title "Rotary and gyroscopic inertia under a moving, rotating load (a = 0.5, k_{ω} = 1)"
set logscale xy
set format y "10^{%T}"
set xlabel "radius over length"
set ylabel "max |ΔU| / U_s"
set xrange [0.008:0.13]
set xtics (0.01, 0.02, 0.05, 0.1)
set key at graph 0.97,0.52
of(spin) = column("spin") == spin ? 1 : NaN
plot csv("model") using "radius_over_length":(of(0) * column("change")) with linespoints linewidth 2 pointtype 7 linecolor rgb blue title "change, no spin", \
     csv("model") using "radius_over_length":(of(2000) * column("change")) with linespoints linewidth 2 pointtype 5 linecolor rgb red title "change, 2000 rad/s", \
     csv("model") using "radius_over_length":(of(0) * column("error")) with linespoints dashtype 2 pointtype 6 linecolor rgb blue title "error of the elements, no spin", \
     csv("model") using "radius_over_length":(of(2000) * column("error")) with linespoints dashtype 2 pointtype 4 linecolor rgb red title "error of the elements, 2000 rad/s"
