# What default runs tell of their error, over what it is, against the error: in time, and in all.
width = 1300; height = 640
load folder . "/../style.gp"
set datafile missing NaN
array family[18] = ["incline", "friction", "curved wire", "rod pendulum", "swinging weight", "elastic rope", "over a ring", "winch", "moving force", \
  "moving mass", "turning rod", "collision", "elastica", "arc", "catenary", "bar wave", "shaken cantilever", "three weights"]
array tint[18] = [0x1f77b4, 0xff7f0e, 0x2ca02c, 0xd62728, 0x9467bd, 0x8c564b, 0xe377c2, 0x7f7f7f, 0xbcbd22, 0x17becf, 0x08306b, 0xfd8d3c, \
  0x31a354, 0xcb181d, 0x54278f, 0x636363, 0x252525, 0xa6611a]
shape(i) = (i % 3 == 0) ? 9 : (i % 3 == 1) ? 7 : 5
which(name) = sum [i=1:18] (family[i] eq name ? i : 0)
kind(k) = shape(which(strcol("family")))
hue(k) = tint[int(which(strcol("family")))]
set multiplot layout 1,2 title "What default runs tell of their error" margins 0.085,0.81,0.12,0.86 spacing 0.07,0.1
set logscale xy
set format xy "10^{%T}"
set xrange [1e-13:1e2]
set yrange [1e-5:1e7]
set ylabel "error told / error [-]"
set title "(a) of the steps, against a run of the same mesh"
set xlabel "error in time / motion [-]"
unset key
set object 1 rectangle from graph 0, first 0.6667 to graph 1, first 20 fillcolor rgb "#e8f4e8" fillstyle solid noborder behind
plot csv("scenes") using (column("true_time")/column("motion")):(column("told_time")/column("true_time")):(kind(0)):(hue(0)) with points pointtype variable pointsize 0.55 linecolor rgb variable, \
     1 with lines dashtype 2 linecolor rgb "#888888"
set title "(b) of steps and mesh, against the answer"
set xlabel "error / motion [-]"
unset ylabel
set key at screen 0.99, screen 0.86 top right Left reverse samplen 0.5 spacing 1.15 font ",12"
plot csv("scenes") using (column("true") > column("known_to") ? column("true")/column("motion") : NaN):"told_over_true":(kind(0)):(hue(0)) with points pointtype variable pointsize 0.55 linecolor rgb variable notitle, \
     for [i=1:18] keyentry with points pointtype shape(i) pointsize 0.55 linecolor rgb tint[i] title family[i], \
     1 with lines dashtype 2 linecolor rgb "#888888" notitle
unset multiplot
