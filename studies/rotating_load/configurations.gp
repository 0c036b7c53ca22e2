# Figures 7 and 9 of the paper: the shaft's axis and its projections. `set` is slow or fast.
width = 1100; height = 900
load folder . "/../moving_string/style.gp"
what = set eq "slow" ? "Figure 7: a = 0.5, k_{ω} = 1" : "Figure 9: a = 1.5, k_{ω} = 0.5"
set multiplot layout 2,2 title what . ", load at 1/4 ... 4/4 of the length. Lines: 4 elements; points: closed form"
of(q) = strcol("set") eq set && column("quarter") == q ? 1 : NaN
high = set eq "slow" ? 2.5 : 1.5
low = -high
set xrange [0:1]
set yrange [low:high]
set zrange [low:high]
set xyplane at low
set view 62, 40, 1, 1.15
set ytics 1
set ztics 1
set xlabel "X_3 / l"
set ylabel "U_2 / U_s"
set zlabel "U_1 / U_s" rotate parallel offset 1.2,0
set xtics 0.5
set key top right font ",12"
letters = "(a) (b) (c) (d)"
do for [q=1:4] {
  set title word(letters, q) . " load at " . q . "/4"
  splot csv("shapes") using (of(q) * column("z_over_l")):"U2":"U1" with lines linewidth 2.5 linecolor rgb blue title "axis", \
        csv("shapes") using (of(q) * column("z_over_l")):"exact_U2":"exact_U1" every 2 with points pointtype 6 pointsize 0.7 linecolor rgb blue, \
        csv("shapes") using (of(q) * column("z_over_l")):(high):"U1" with lines linewidth 1.5 linecolor rgb green title "on X_1 X_3", \
        csv("shapes") using (of(q) * column("z_over_l")):(high):"exact_U1" every 4 with points pointtype 6 pointsize 0.5 linecolor rgb green, \
        csv("shapes") using (of(q) * column("z_over_l")):"U2":(low) with lines linewidth 1.5 linecolor rgb red title "on X_2 X_3", \
        csv("shapes") using (of(q) * column("z_over_l")):"exact_U2":(low) every 4 with points pointtype 6 pointsize 0.5 linecolor rgb red
}
unset multiplot
