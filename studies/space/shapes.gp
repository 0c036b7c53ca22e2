# A rod rolled up to a helix and the bend of 45 degrees, in perspective.
width = 1100; height = 600
load folder . "/style.gp"
set multiplot layout 1,2 title "Large turns in space" margins 0.09,0.89,0.10,0.84 spacing 0.13,0.1
set view 62, 32, 1.0, 1
set view equal xyz
set xyplane relative 0.05
set grid x y z vertical
set border 4095 linecolor rgb "#cccccc"
set xlabel "x [m]"
set ylabel "y [m]"
set zlabel "z [m]" rotate parallel
set key at screen 0.5, 0.9 center top vertical maxrows 1 notitle samplen 1.5
colors = "#bbbbbb #9ecae1 #6baed6 #2171b5 #08306b"
shares = "0 1/8 1/4 1/2 1"
coordinate(problem, i, name) = strcol("problem") eq problem && column("shape") == i ? column(name) : NaN
set title "(a) a moment rolls a rod up to a helix"
set xtics 0.25; set ytics 0.1; set ztics 0.2
splot for [i=0:4] csv("shapes") using (coordinate("helix", i, "x")):(coordinate("helix", i, "y")):(coordinate("helix", i, "z")) \
  with lines linewidth 2 linecolor rgb word(colors, i + 1) title word(shares, i + 1)." of the load"
set title "(b) bend of 45 degrees under 600 across its plane"
set view 65, 120, 0.8, 1
set xtics 20; set ytics 20; set ztics 20
unset key
splot for [i=0:4] csv("shapes") using (coordinate("bend", i, "x")):(coordinate("bend", i, "y")):(coordinate("bend", i, "z")) \
  with lines linewidth 2 linecolor rgb word(colors, i + 1) notitle
unset multiplot
