# Copies the headers of SOURCE to HEADERS as users include them: core/x.hpp becomes vlbeam/core/x.hpp, mechanics/x.hpp
# vlbeam/mechanics/x.hpp, scene/x.hpp vlbeam/scene/x.hpp, studies/harness/x.hpp becomes vlbeam/harness/x.hpp.
file(REMOVE_RECURSE ${HEADERS})
file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/core/*.hpp ${SOURCE}/mechanics/*.hpp ${SOURCE}/scene/*.hpp ${SOURCE}/studies/harness/*.hpp ${SOURCE}/include/*.hpp)
foreach(header IN LISTS headers)
  file(READ ${SOURCE}/${header} text)
  string(REPLACE "#include \"core/" "#include \"vlbeam/core/" text "${text}")
  string(REPLACE "#include \"mechanics/" "#include \"vlbeam/mechanics/" text "${text}")
  string(REPLACE "#include \"scene/" "#include \"vlbeam/scene/" text "${text}")
  string(REPLACE "#include \"studies/harness/" "#include \"vlbeam/harness/" text "${text}")
  string(REGEX REPLACE "^(include/vlbeam|studies)/" "" place ${header})
  file(WRITE ${HEADERS}/vlbeam/${place} "${text}")
endforeach()
