# Hanging ropes against elastic catenaries: errors of shape and tension against the mesh, for all stiffnesses.
width = 1400; height = 520
load folder . "/style.gp"
set multiplot layout 1,2 title "Hanging ropes of stiffness EA = 10 to 1e7 times their weight, against elastic catenaries" margins 0.08,0.98,0.14,0.82 spacing 0.1,0.1
set logscale xy
set format y "10^{%T}"
set xlabel "elements"
set xtics (8, 16, 32, 64)
set xrange [7:74]
set key bottom left Left noreverse samplen 1.5
names = "'between two pins' 'with a free end' 'through a ring'"
colour(i) = word("#08306b #31a354 #fd8d3c", i + 1)
shape(i) = 5 + 2*i
stiff = "10 1000 100000 10000000"
row(i, k) = column("hanging") == i && column("stiffness") == word(stiff, k) + 0
set title "(a) shape, over the length"
set ylabel "largest error [-]"
set yrange [1e-12:1e-1]
set key top right
plot for [i=0:2] for [k=1:4] csv("catenaries") using (row(i, k) ? column("elements") : NaN):"shape" with points pointtype shape(i) pointsize 0.6 + 0.25*k linecolor rgb colour(i) title (k == 2 ? word(names, i + 1) : ""), \
     0.3*x**(-4) with lines dashtype 2 linecolor rgb "#888888" title "order 4"
set title "(b) tension, over the largest one"
set yrange [1e-7:1e-1]
set key bottom left
plot for [i=0:2] for [k=1:4] csv("catenaries") using (row(i, k) ? column("elements") : NaN):"tension" with points pointtype shape(i) pointsize 0.6 + 0.25*k linecolor rgb colour(i) title (k == 2 ? word(names, i + 1) : ""), \
     0.01 with lines dashtype 3 linecolor rgb "#cb181d" title "1 %"
unset multiplot
