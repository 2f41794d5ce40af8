// Rows for dispatch_test: the best one supported is neither the first nor the last.
VNDF_ISA(plain, true)
VNDF_ISA(better, true)
VNDF_ISA(absent, false)
VNDF_ISA(best, true)
VNDF_ISA(future, false)
#undef VNDF_ISA
