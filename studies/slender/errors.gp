# Error against the mesh, and on one mesh against the slenderness. Full strain dashed, sampled strain solid.
width = 1400; height = 500
load folder . "/style.gp"
set multiplot layout 1,3 title "Slender beams: axial strain at all points (dashed) and sampled (solid), ALE-ANCF" margins 0.07,0.82,0.14,0.82 spacing 0.08,0.1
set logscale xy
set format y "10^{%T}"
set xlabel "elements"
set ylabel "error of the end / L"
this(p, s, a) = strcol("problem") eq p && column("slenderness") == s && strcol("axial_strain") eq a && strcol("element") eq "ALE-ANCF" ? column("error") : NaN
colour(i) = word("#08306b #2171b5 #31a354 #fd8d3c", i)
slenderness = "1e2 1e4 1e6 1e8"
slender(i) = 10.0**(2*i)
set title "(a) elastica, P L^2/EI = 10"
set xtics (2, 4, 8, 16, 32, 64)
set key at screen 0.995,0.9 top right title "EA L^2/EI in (a)" samplen 1.5
plot for [i=1:4] csv("errors") using "elements":(this("elastica", slender(i), "full")) with linespoints dashtype 2 linewidth 1.6 pointtype 6 pointsize 0.6 linecolor rgb colour(i) notitle, \
     for [i=1:4] csv("errors") using "elements":(this("elastica", slender(i), "lobatto")) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(slenderness, i)
set title "(b) the same, N = 16"
set xlabel "EA L^2/EI"
unset ylabel
set xtics auto
set format x "10^{%T}"
set key at screen 0.995,0.55 top right title "(b)" samplen 1.5
on(n, a) = strcol("problem") eq "elastica" && column("elements") == n && strcol("axial_strain") eq a && strcol("element") eq "ALE-ANCF" ? column("error") : NaN
taken(n) = strcol("problem") eq "elastica" && column("elements") == n && column("taken") == 1 && strcol("element") eq "ALE-ANCF" ? column("error") : NaN
plot csv("errors") using "slenderness":(on(16, "full")) with linespoints dashtype 2 linewidth 1.6 pointtype 6 pointsize 0.6 linecolor rgb "#444444" title "full", \
     csv("errors") using "slenderness":(on(16, "lobatto")) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb "#444444" title "lobatto", \
     csv("errors") using "slenderness":(taken(16)) with points pointtype 6 pointsize 1.6 linewidth 1.6 linecolor rgb "#d62728" title "default"
set title "(c) other problems"
set xlabel "elements"
set format x "%g"
set xtics (4, 8, 16, 32, 64)
set ylabel "error [m]; bent: relative"
set key at screen 0.995,0.32 top right title "(c)" samplen 1.5
names = "'arm scale, EA = 1e7 N' 'sleeve, EA = 1e7 N' 'falling beam' 'bent, frequencies'"
problems = "arm_scale rod_in_sleeve falling bent"
ea(i) = i <= 2 ? 1e7 : i == 3 ? 4e4 : 1e8
plot for [i=1:4] csv("errors") using "elements":(this(word(problems, i), ea(i), "full")) with linespoints dashtype 2 linewidth 1.6 pointtype 6 pointsize 0.6 linecolor rgb colour(i) notitle, \
     for [i=1:4] csv("errors") using "elements":(this(word(problems, i), ea(i), "lobatto")) with linespoints linewidth 1.8 pointtype 7 pointsize 0.6 linecolor rgb colour(i) title word(names, i)
unset multiplot
