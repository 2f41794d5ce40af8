// What the library finds out about the processor: VNDF_NEWEST is the newest set that it has.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include <vndf/vndf.h>

namespace {

const std::string newest = std::getenv("VNDF_NEWEST");

TEST(Processor, SetInUse) {
  EXPECT_EQ(vndf::active_isa(), newest);
}

TEST(Processor, NewerSetsAreRefused) {
  bool newer = false;
  for (const vndf::Isa& isa : vndf::isas()) {
    EXPECT_NE(isa.supported, newer) << isa.name;
    EXPECT_EQ(vndf::set_isa(isa.name), newer ? vndf::IsaError::unsupported : vndf::IsaError::none) << isa.name;
    newer |= isa.name == newest;
  }
  EXPECT_TRUE(newer) << newest << " is not compiled in";
}

}  // namespace
