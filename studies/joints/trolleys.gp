# Where two trolleys are on a rope, and where they are in space.
width = 900; height = 460
load folder . "/../moving_string/style.gp"
set multiplot layout 1,2 title "Two trolleys on a rope"
set xlabel "t (s)"
set ylabel "material coordinate (m)"
set key top left
plot csv("trolleys") using "t":"x_0" with lines linewidth 2 linecolor rgb blue title "0.8 kg", \
     csv("trolleys") using "t":"x_1" with lines linewidth 2 linecolor rgb red title "0.4 kg"
set xlabel "X (m)"
set ylabel "Y (m)"
set key top right
plot csv("trolleys") using "X_0":"Y_0" with lines linewidth 2 linecolor rgb blue title "path of 0.8 kg", \
     csv("trolleys") using "X_1":"Y_1" with lines linewidth 2 linecolor rgb red title "path of 0.4 kg"
unset multiplot
