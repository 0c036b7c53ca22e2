# A steel wire of 1 mm radius with a sliding mass: error, steps, and energy that events move, against the mesh.
width = 1400; height = 470
load folder . "/style.gp"
set multiplot layout 1,3 title "Steel wire, radius 1 mm, with 20 g sliding on it, to 0.5 s, by default (accuracy 1e-4)" margins 0.07,0.85,0.14,0.82 spacing 0.09,0.1
set logscale xy
set format y "10^{%T}"
set xlabel "elements"
set xtics (8, 16, 32, 64)
set xrange [7:75]
this(e, a, value) = column("accuracy") == 1e-4 && strcol("element") eq e && strcol("axial_strain") eq a ? column(value) : NaN
elements = "ALE-ANCF ALE-RANCF"
strains = "full lobatto"
colour(i) = word("#08306b #fd8d3c", i)
name(i, s) = word(elements, i) . ", " . word(strains, s)
set title "(a) position of the joint"
set ylabel "error [m]"
set key at screen 0.995,0.9 top right samplen 1.5
plot for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "full", "error")) with linespoints dashtype 2 linewidth 1.7 pointtype 6 pointsize 0.7 linecolor rgb colour(i) title name(i, 1), \
     for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "lobatto", "error")) with linespoints linewidth 1.7 pointtype 7 pointsize 0.7 linecolor rgb colour(i) title name(i, 2)
unset key
set title "(b) steps"
set ylabel "steps"
plot for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "full", "steps")) with linespoints dashtype 2 linewidth 1.7 pointtype 6 pointsize 0.7 linecolor rgb colour(i), \
     for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "lobatto", "steps")) with linespoints linewidth 1.7 pointtype 7 pointsize 0.7 linecolor rgb colour(i)
set title "(c) strain energy that events move"
set ylabel "energy [J]"
plot for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "full", "moved")) with linespoints dashtype 2 linewidth 1.7 pointtype 6 pointsize 0.7 linecolor rgb colour(i), \
     for [i=1:2] csv("wires") using "elements":(this(word(elements, i), "lobatto", "moved")) with linespoints linewidth 1.7 pointtype 7 pointsize 0.7 linecolor rgb colour(i)
unset multiplot
