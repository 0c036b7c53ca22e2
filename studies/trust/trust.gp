# What default runs tell of their error, over what it is, against the error: in time, and in all.
width = 1300; height = 640
load folder . "/../style.gp"
set datafile missing NaN
array family[18] = ["incline", "friction", "curved wire", "rod pendulum", "swinging weight", "elastic rope", "over a ring", "winch", "moving force", \
  "moving mass", "turning rod", "collision", "elastica", "arc", "catenary", "bar wave", "shaken cantilever", "three weights"]
colour(i) = word("#1f77b4 #ff7f0e #2ca02c #d62728 #9467bd #8c564b #e377c2 #7f7f7f #bcbd22 #17becf #08306b #fd8d3c #31a354 #cb181d #54278f #636363 #252525 #a6611a", i)
shape(i) = (i % 3 == 0) ? 9 : (i % 3 == 1) ? 7 : 5
set multiplot layout 1,2 title "What default runs tell of their error" margins 0.06,0.80,0.12,0.86 spacing 0.07,0.1
set logscale xy
set format xy "10^{%T}"
set xrange [1e-13:1e2]
set yrange [1e-5:1e7]
set ylabel "error told / error [-]"
of(i, x) = strcol("family") eq family[i] ? x : NaN
set title "(a) of the steps, against a run of the same mesh"
set xlabel "error in time / motion [-]"
unset key
set object 1 rectangle from graph 0, first 0.6667 to graph 1, first 20 fillcolor rgb "#e8f4e8" fillstyle solid noborder behind
plot for [i=1:18] csv("scenes") using (of(i, column("true_time")/column("motion"))):(column("told_time")/column("true_time")) with points pointtype shape(i) pointsize 0.55 linecolor rgb colour(i), \
     1 with lines dashtype 2 linecolor rgb "#888888"
set title "(b) of steps and mesh, against the answer"
set xlabel "error / motion [-]"
unset ylabel
set key at screen 0.99, screen 0.86 top right Left reverse samplen 0.5 spacing 1.15 font ",12"
plot for [i=1:18] csv("scenes") using (of(i, column("true") > column("known_to") ? column("true")/column("motion") : NaN)):"told_over_true" with points pointtype shape(i) pointsize 0.55 linecolor rgb colour(i) title family[i], \
     1 with lines dashtype 2 linecolor rgb "#888888"
unset multiplot
