# Figure 9: configurations of beam and mass through time.
width = 1200; height = 450
load folder . "/style.gp"
set multiplot layout 1,2 title "Configurations, N = " . elements . "\n{/*0.85 " . setting . "}"
set size ratio -1
set xrange [-0.75:1.1]
set yrange [-1.02:0.1]
set xtics 0.25
set ytics 0.25
set xlabel "X (m)"
set ylabel "Y (m)"
# Dark blue to orange with time.
set palette defined (0 "#08306b", 0.25 "#2171b5", 0.5 "#6baed6", 0.75 "#fdae6b", 1 "#a63603")
unset colorbox
last = real(word(times, words(times)))
do for [e in "rancf ancf"] {
  set title panel_title(e)
  left = e eq "rancf" ? 0.075 : 0.525
  set lmargin at screen left
  set rmargin at screen left + 0.38
  if (e eq "rancf") { unset key } else { set key at screen 0.995, screen 0.78 top right title "t (s)" spacing 0.95 samplen 1.6 }
  plot for [t in times] csv("configurations_" . sweep) using e."_".t."_x":e."_".t."_y" with lines linewidth 2 \
         linecolor palette frac (real(t)/last) title t, \
       csv("configuration_masses_" . sweep) using e."_x":e."_y":(column("t")/last) with points pointtype 7 pointsize 1 \
         linecolor palette
}
unset multiplot
