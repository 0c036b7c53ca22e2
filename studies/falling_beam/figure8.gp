# Figure 8: the beam at t = 0, and below it the nodes of each mesh.
width = 860; height = 460
load folder . "/style.gp"
unset grid
stats csv("initial_nodes") using "row" nooutput
set multiplot layout 2,1
set title "Falling beam with a sliding mass at t = 0"
unset border
unset tics
set xrange [-0.12:1.12]
set yrange [-0.3:0.24]
set bmargin 0
set lmargin 10
set rmargin 3
set arrow 1 from 0,-0.1 to 0,0.1 nohead linewidth 3 linecolor rgb "#222222"
do for [i=0:6] {
  set arrow 10+i from 0,-0.1+0.2*i/6. to -0.02,-0.13+0.2*i/6. nohead linewidth 1 linecolor rgb "#222222"
}
set arrow 2 from 0,-0.2 to 1,-0.2 heads size 0.012,20 linewidth 1 linecolor rgb "#666666"
set label 2 "1 m, radius 0.01 m, ρ = 7200 kg/m^3, E = 20 MPa" at 0.55,-0.15 center textcolor rgb "#444444"
set arrow 3 from 0,0.12 to 0.1,0.12 heads size 0.012,20 linewidth 1 linecolor rgb "#666666"
set label 3 "0.1 m" at 0.05,0.18 center textcolor rgb "#444444"
set label 4 "sliding mass 0.8 kg" at 0.13,0.07 textcolor rgb "#a63603"
set arrow 5 from 1.07,0.12 to 1.07,-0.12 size 0.015,20 linewidth 1.5 linecolor rgb "#222222"
set label 5 "g = 9.81 m/s^2" at 1.05,0 right offset 0,1.4 textcolor rgb "#444444"
plot "-" using 1:2 with lines linewidth 4 linecolor rgb "#08519c", \
     "-" using 1:2 with points pointtype 7 pointsize 1.8 linecolor rgb "#a63603"
0,0
1,0
e
0.1,0
e
unset arrow
unset label
unset title
set border 1
set tics
set bmargin 3.5
set tmargin 0
set xlabel "material coordinate x (m)"
set xtics 0,0.1,1 nomirror
set yrange [STATS_max + 0.8:0.3]
set ytics nomirror scale 0
set ylabel "elements N"
plot csv("initial_nodes") using "x":"row":ytic(2) with points pointtype 7 pointsize 0.5 linecolor rgb "#08519c", \
     "" using (column("joint") == 1 ? column("x") : NaN):"row" with points pointtype 7 pointsize 1.1 linecolor rgb "#a63603"
unset multiplot
