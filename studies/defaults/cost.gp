# Error in time and work of scenes whose integrator is left to the program, at an accuracy of 1e-4.
width = 900; height = 720
load folder . "/../moving_string/style.gp"
stats csv("cost_figure") using "place" nooutput
set multiplot title "Scenes whose integrator is left to the program, at an accuracy of 1e-4"
set yrange [STATS_max + 0.7:0.3]
set logscale x
set ytics nomirror noenhanced
set key below
set tmargin at screen 0.86
set bmargin at screen 0.17
set lmargin at screen 0.24
set rmargin at screen 0.60
set title "(a) error in time"
set xlabel "largest error of positions / length"
set format x "10^{%T}"
set xrange [7e-10:1e-3]
plot csv("cost_figure") using "error":"place":ytic(strcol("scene")) with points pointtype 7 linecolor rgb blue title "1e-9 and below at the edge" noenhanced, \
     csv("cost_figure") using (2e-4):"place" with lines linecolor rgb red title "twice the accuracy"
set lmargin at screen 0.64
set rmargin at screen 0.97
set title "(b) work"
set xlabel "work / that of the cheapest setting"
unset format
set format y ""
set xrange [0.8:20]
set xtics (1, 2, 3, 5, 10, 20)
plot csv("cost_figure") using "ratio":"place":ytic("") with points pointtype 7 linecolor rgb blue notitle, \
     csv("cost_figure") using (3):"place" with lines linecolor rgb red title "bound of the mean", \
     csv("cost_figure") using (10):"place" with lines dashtype 2 linecolor rgb red title "bound of each"
unset multiplot
