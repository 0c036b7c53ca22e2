# Figure 13: configurations of beam and mass through time.
width = 1250; height = 480
load folder . "/style.gp"
set multiplot layout 1,3 title "A suspended beam with a sliding mass of 5 kg: configurations\n{/*0.85 " . setting . "}"
set xrange [-0.05:1.05]
set yrange [-0.14:0.02]
set xlabel "X (m)"
set ylabel "Y (m)" offset 1,0
set palette defined (0 "#08306b", 0.25 "#2171b5", 0.5 "#6baed6", 0.75 "#fdae6b", 1 "#a63603")
unset colorbox
last = real(word(times, words(times)))
panel(i) = word("(a) (b) (c)", i)
do for [i=1:3] {
  e = word("rancf ancf finer", i)
  set title panel(i) . " " . (e eq "finer" ? "ALE-ANCF, variational, N = " . finer : element_name(e) . ", N = " . elements)
  left = 0.07 + 0.295*(i - 1)
  set lmargin at screen left
  set rmargin at screen left + 0.225
  if (i < 3) { unset key } else { set key at screen 0.995, screen 0.8 top right title "t (s)" spacing 0.95 samplen 1.6 }
  plot for [t in times] csv("configurations_" . key) using e."_".t."_x":e."_".t."_y" with lines linewidth 2 \
         linecolor palette frac (real(t)/last) title t, \
       csv("masses_" . key) using (strcol("element") eq e ? column("x") : NaN):"y":(column("t")/last) \
         with points pointtype 7 pointsize 1 linecolor palette
}
unset multiplot
