# Error against the number of Gauss points: one element's energy, and the motion of the falling beam.
width = 1400; height = 470
load folder . "/../style.gp"
set multiplot layout 1,3 title "Gauss points an element" margins 0.07,0.8,0.14,0.82 spacing 0.09,0.1
set logscale y
set format y "10^{%T}"
set xlabel "points"
set yrange [1e-17:10]
set ylabel "relative error"
ratios = "1 1.2 1.5 2 3 5"
colour(i) = word("#000000 #08306b #2171b5 #6baed6 #fd8d3c #a63603", i)
unset key
this(r, value) = column("skew") == 0 && column("ratio") == real(r) ? column(value) + 1e-17 : NaN
set title "(a) axial energy, weights (1, w, w, 1)"
plot for [i=1:6] csv("integrals") using "points":(this(word(ratios, i), "axial")) with linespoints linewidth 1.6 pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(ratios, i)
set title "(b) bending energy, the same"
set key at screen 0.995,0.9 top right title "w in (a), (b)"
unset ylabel
plot for [i=1:6] csv("integrals") using "points":(this(word(ratios, i), "bending")) with linespoints linewidth 1.6 pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(ratios, i)
set title "(c) falling beam"
set ylabel "error / L against 25 points"
set yrange [1e-10:1]
set key at screen 0.995,0.45 top right title "(c)" samplen 1.5 spacing 0.9 font ",12"
set yrange [1e-13:10]
cases = "rancf_n5 rancf_n10 rancf_n20 ancf_n5 ancf_n10 ancf_n20 unequal_n10"
names = "'ALE-RANCF, N = 5' 'N = 10' 'N = 20' 'ALE-ANCF, N = 5' 'N = 10' 'N = 20' 'weights 1, 0.7, 1.4, 1; N = 10'"
shade(i) = word("#9ecae1 #4292c6 #08306b #fdae6b #f16913 #7f2704 #31a354", i)
plot for [i=1:7] csv("motion") using "points":(strcol("case") eq word(cases, i) ? column("error") : NaN) with linespoints linewidth 1.8 pointtype (i > 3 ? 6 : 7) pointsize 0.7 linecolor rgb shade(i) title word(names, i)
unset multiplot
