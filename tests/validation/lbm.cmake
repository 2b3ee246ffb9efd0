# The fluid against exact solutions and published tables.
foreach(name channel vortex cavity porous)
  suffuse_catch_test(NAME validation_lbm_${name} SOURCES lbm_${name}_test.cpp LINKS suffuse::lbm_solver
    LABELS fluid validation RANKS 1)
endforeach()
