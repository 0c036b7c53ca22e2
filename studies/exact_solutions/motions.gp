set terminal svg
set output output
plot x
