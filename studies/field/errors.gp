# How far printed numbers and ours, by default, are from the answer: a point a number.
width = 900; height = 620
load folder . "/../style.gp"
set datafile columnheaders
set title "Errors of numbers that others print, and of ours by default"
set logscale xy
set format xy "10^{%T}"
set xlabel "error of the printed number / answer [-]"
set ylabel "error of ours / answer [-]"
set xrange [3e-14:3]
set yrange [3e-14:3e-2]
set key outside right top Left reverse samplen 0.5 spacing 0.95 width -1 font ",12.5" noenhanced
communities = "EXUDYN VirtualBow AeroBeams BeamDyn SHARPy GXBeam Kynema Abaqus Chrono XC MoorPy MoorDyn MAP++ OrcaFlex FRyDoM Code_Aster OTLS"
tints = "1f77b4 ff7f0e 2ca02c d62728 9467bd 8c564b e377c2 7f7f7f bcbd22 17becf 08306b fd8d3c 31a354 cb181d 54278f 252525 a6611a"
n = words(communities)
above(x) = x > 1e-13 ? x : 1e-13
of(name) = strcol("community") eq name
shape(k) = strcol("verdict") eq "agree" ? 6 : strcol("verdict") eq "off" ? 7 : 9
ours(i) = of(word(communities, i)) ? above(column("our_error")) : NaN
others(k) = of("printed tables") ? above(column("our_error")) : NaN
rte(k) = of("RTE mechaphlowers") ? above(column("our_error")) : NaN
plot x with lines dashtype 2 linecolor rgb "#888888" title "equal", \
     keyentry with points pointtype 6 pointsize 0.8 linecolor rgb "#444444" title "printed: agrees to its digits", \
     keyentry with points pointtype 7 pointsize 0.8 linecolor rgb "#444444" title "printed: off", \
     keyentry with points pointtype 9 pointsize 0.8 linecolor rgb "#444444" title "printed: another model", \
     for [i=1:n] csv("numbers") using (above(column("their_error"))):(ours(i)):(shape(0)) with points pointtype variable pointsize 0.8 \
       linecolor rgb "#" . word(tints, i) notitle, \
     csv("numbers") using (above(column("their_error"))):(others(0)):(shape(0)) with points pointtype variable pointsize 0.8 linecolor rgb "#636363" notitle, \
     csv("numbers") using (above(column("their_error"))):(rte(0)):(shape(0)) with points pointtype variable pointsize 0.8 linecolor rgb "#00a0a0" notitle, \
     for [i=1:n] keyentry with points pointtype 5 pointsize 0.8 linecolor rgb "#" . word(tints, i) title word(communities, i), \
     keyentry with points pointtype 5 pointsize 0.8 linecolor rgb "#00a0a0" title "RTE mechaphlowers", \
     keyentry with points pointtype 5 pointsize 0.8 linecolor rgb "#636363" title "printed tables"
