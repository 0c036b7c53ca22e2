# Figure 14: shapes before and after length control, length of the beam, its rate, energies.
width = 1200; height = 950
load folder . "/style.gp"
set multiplot layout 2,2 margins 0.075,0.975,0.07,0.88 spacing 0.09,0.13 title "A suspended beam with a sliding mass of 5 kg, N = " . elements . "\n{/*0.85 " . setting . "; finer: ALE-ANCF, variational, N = " . finer . "}"
histories = csv("histories_" . key)
shapes = csv("length_control_" . key)
set title "(a) configurations at the first two length controls (LC)"
set xlabel "X (m)"
set ylabel "Y (m)"
set yrange [-0.16:0]
set key bottom center samplen 2 maxrows 2 width -4
plot for [e in "rancf ancf"] for [k=1:2] shapes using e."_".k."_before_x":e."_".k."_before_y" with lines linewidth 4 \
       linecolor rgb (e eq "rancf" ? "#9ecae1" : "#fdae6b") title (k == 1 ? element_name(e) . ", before" : ""), \
     for [e in "rancf ancf"] for [k=1:2] shapes using e."_".k."_after_x":e."_".k."_after_y" with lines linewidth 1.5 \
       dashtype 2 linecolor rgb element_colour(e) title (k == 1 ? element_name(e) . ", after" : "")
set xlabel "t (s)"
set xrange [0:*]
set yrange [1:1.055]
set title "(b) length of the beam"
set ylabel "length (m)"
set key top center horizontal samplen 2 width 4
plot for [e in "finer ancf rancf"] histories using "t":e."_length" with lines linewidth (e eq "finer" ? 2.5 : 1.3) \
       linecolor rgb element_colour(e) title (e eq "finer" ? "finer" : element_name(e))
set title "(c) rate of the length"
set yrange [*:*]
set ylabel "rate (m/s)"
unset key
plot for [e in "finer ancf rancf"] histories using "t":e."_rate" with lines linewidth 1.3 \
       linecolor rgb element_colour(e)
set title "(d) energies"
set ylabel "energy (J)"
set yrange [*:10]
set key inside top center horizontal maxrows 1 samplen 2 width -1
quantities = "kinetic strain gravity total"
dash(q) = q eq "kinetic" ? 1 : q eq "strain" ? 4 : q eq "gravity" ? 2 : 1
plot for [e in "finer ancf rancf"] for [q in quantities] histories using "t":e."_".q with lines \
       linewidth (q eq "total" ? 3 : 1.3) dashtype dash(q) linecolor rgb element_colour(e), \
     for [q in quantities] keyentry with lines linewidth (q eq "total" ? 3 : 1.3) dashtype dash(q) \
       linecolor rgb "#444444" title q
unset multiplot
