# Ropes beside their closed forms: weights over a guide, friction around it, a pendulum that is hoisted.
width = 1400; height = 500
load folder . "/style.gp"
set multiplot layout 1,3 title "Ropes: vlbeam (points) and closed forms (lines)" margins 0.07,0.98,0.14,0.82 spacing 0.08,0.1
this(key, i) = column(key) == word(values, i) + 0
colour(i) = word("#08306b #31a354 #fd8d3c #cb181d", i)

set title "(a) 3 kg and 2 kg over a smooth guide"
set xlabel "time [s]"
set ylabel "way [m]"
values = "0.001 0.05 0.5 2"
set key top left Left reverse samplen 1 title "rope [kg/m]"
plot for [i=1:4] csv("atwood") using (this("rhoA", i) ? column("t") : NaN):"exact" with lines linewidth 1.5 linecolor rgb colour(i), \
     for [i=1:4] csv("atwood") using (this("rhoA", i) ? column("t") : NaN):"way" with points pointtype 7 pointsize 0.5 linecolor rgb colour(i) title word(values, i)

set title "(b) a rope that slips around a guide"
set xlabel "angle around it [rad]"
set ylabel "ratio of its tensions [-]"
values = "0.1 0.2 0.3 0.5"
set key top left Left reverse samplen 1 title "coefficient of friction"
plot for [i=1:4] csv("capstan") using (this("coefficient", i) ? column("angle") : NaN):"exact" with lines linewidth 1.5 linecolor rgb colour(i), \
     for [i=1:4] csv("capstan") using (this("coefficient", i) ? column("angle") : NaN):"ratio" with points pointtype 7 pointsize 0.5 linecolor rgb colour(i) title word(values, i)

set title "(c) a pendulum that is hoisted slowly"
set xlabel "length before over length after [-]"
set ylabel "amplitude after over before [-]"
set key top left Left reverse samplen 1 notitle
plot csv("hoist") using "lengths":"exact" with lines linewidth 1.5 linecolor rgb "#08306b" title "power 3/4", \
     csv("hoist") using "lengths":"amplitudes" with points pointtype 7 pointsize 0.7 linecolor rgb "#fd8d3c" title "vlbeam"
unset multiplot
