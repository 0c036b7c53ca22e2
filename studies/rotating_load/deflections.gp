# Figures 8 and 10 of the paper. `set` is slow or fast.
width = 1100; height = 500
load folder . "/../moving_string/style.gp"
what = set eq "slow" ? "Figure 8: a = 0.5, k_{ω} = 1" : "Figure 10: a = 1.5, k_{ω} = 0.5"
set multiplot layout 1,2 title what . ". Lines: 4 elements; points: closed form"
of(s) = strcol("set") eq s ? 1 : NaN
set xlabel "position of the load z/l"
set ylabel "U / U_s"
set xrange [0:1]
set key top left
set title "(a) loaded point"
plot csv("deflections") using "z_over_l":(of(set) * column("load_U1")) with lines linewidth 2 linecolor rgb blue title "U_1", \
     csv("deflections") using "z_over_l":(of(set) * column("exact_load_U1")) every 4 with points pointtype 6 linecolor rgb blue, \
     csv("deflections") using "z_over_l":(of(set) * column("load_U2")) with lines linewidth 2 linecolor rgb red title "U_2", \
     csv("deflections") using "z_over_l":(of(set) * column("exact_load_U2")) every 4 with points pointtype 4 linecolor rgb red
set title "(b) middle"
plot csv("deflections") using "z_over_l":(of(set) * column("middle_U1")) with lines linewidth 2 linecolor rgb blue title "U_1", \
     csv("deflections") using "z_over_l":(of(set) * column("exact_middle_U1")) every 4 with points pointtype 6 linecolor rgb blue, \
     csv("deflections") using "z_over_l":(of(set) * column("middle_U2")) with lines linewidth 2 linecolor rgb red title "U_2", \
     csv("deflections") using "z_over_l":(of(set) * column("exact_middle_U2")) every 4 with points pointtype 4 linecolor rgb red
unset multiplot
