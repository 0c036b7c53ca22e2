# Figure 12: the elements beside the joint before and after length control (LC), carried out twice; below, how far each
# material point was moved by it.
width = 1100; height = 1120
load folder . "/style.gp"
set multiplot layout 3,2 title "Before and after length control (LC), N = " . elements . "\n{/*0.85 " . setting . "}"
nodes = csv("length_control_nodes_" . sweep)
shapes = csv("length_control_" . sweep)
picked(k, e, after, joint) = column("event") == k && column("element") == e && column("after") == after && \
                             column("joint") == joint ? column("x") : NaN
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set xlabel "X (m)"
set ylabel "Y (m)"
do for [k=1:2] {
  if (k == 1) { set key bottom left } else { unset key }  # the same for both
  do for [e=0:1] {
    name = e == 0 ? "rancf" : "ancf"
    set title panel_title(name) . (k == 1 ? ", first LC" : ", second LC")
    c = name . "_lc" . k
    plot shapes using c."_before_x":c."_before_y" with lines linewidth 4 linecolor rgb "#9ecae1" title "before LC", \
         "" using c."_after_x":c."_after_y" with lines linewidth 1.5 dashtype 2 linecolor rgb "#a63603" title "after LC", \
         nodes using (picked(k, e, 0, 0)):"y" with points pointtype 7 pointsize 0.8 linecolor rgb "#4292c6" title "nodes before", \
         nodes using (picked(k, e, 1, 0)):"y" with points pointtype 6 pointsize 1.3 linewidth 1.5 linecolor rgb "#a63603" title "nodes after", \
         nodes using (picked(k, e, 1, 1)):"y" with points pointtype 7 pointsize 1.2 linecolor rgb "#222222" title "sliding node"
  }
}
set offsets 0, 0, 0, 0
set xrange [0:1]
set yrange [0:*]
set xlabel "place in the elements changed (material coordinate, 0 to 1)"
set ylabel "moved by (m)"
set key top left
moved(c) = sqrt((column(c."_after_x") - column(c."_before_x"))**2 + (column(c."_after_y") - column(c."_before_y"))**2)
stats shapes using (moved("ancf_lc1")) name "ancf1" nooutput
stats shapes using (moved("ancf_lc2")) name "ancf2" nooutput
stats shapes using (moved("rancf_lc1")) name "rancf1" nooutput
stats shapes using (moved("rancf_lc2")) name "rancf2" nooutput
larger(a, b) = a > b ? a : b
top = 1.15 * larger(larger(ancf1_max, ancf2_max), larger(rancf1_max, rancf2_max))
set yrange [0:top]
do for [name in "rancf ancf"] {
  set title panel_title(name) . ", displacement of material points by LC"
  plot shapes using "s":(moved(name . "_lc1")) with lines linewidth 2 linecolor rgb "#4292c6" title "first LC", \
       "" using "s":(moved(name . "_lc2")) with lines linewidth 2 dashtype 2 linecolor rgb "#a63603" title "second LC"
}
unset multiplot
