// Inputs that vndf_search found: of each function the worst that are within its bounds.
#include "ratio/subjects.h"

namespace vndf::ratio {
namespace {

struct Row {
  const char* subject;
  std::vector<float> in;
};
const Row kRows[] = {
    {"normals_polar",
     {0x1.617102p-57f, -0x1.f4d89cp-1f, 0x1.a031ccp-10f, 0x1.693eccp-3f, 0x1.6236d6p+5f, 0x1.490584p-9f,
      0x1.fdfa22p-1f}},
    {"reflection_polar",
     {-0x1.ffd4a4p-1f, -0x1.6b91dp-6f, 0x1.fffd7cp-40f, 0x1.11e324p-17f, 0x1.21030ap-9f, 0x1.dbdd02p-9f,
      0x1.8d358ap-7f}},
    {"reflection_bounded_polar",
     {-0x1.67e372p-1f, 0x1.4d271cp-2f, 0x1.43d74p-1f, 0x1.9ec3fcp+5f, 0x1.f8acfp-1f, 0x1.ebcb3ap-1f, 0x1.baf2ep-84f}},
    {"reflection_turned_polar",
     {0x1.023ddcp-27f, -0x1.d1e986p-8f, 0x1.fffcb4p-1f, 0x1.1bd10ap-10f, 0x1.1bf7ep-3f, 0x1.fbd842p-6f, 0x1.e15a1ep-17f,
      0x1.9c9a38p-1f}},
    {"reflection_tilted_polar",
     {0x1.59de78p-6f, 0x1.8f3e42p-8f, 0x1.ffe076p-1f, 0x1.4bf896p-2f, 0x1.1bf6b6p-3f, -0x1.1a7a44p-21f,
      -0x1.0c451cp-15f, -0x1.df9d3ap-30f, 0x1.a62efp-9f, 0x1.8b2704p-3f}},
    {"dielectric_polar",
     {-0x1.f6109p-6f, 0x1.c00b56p-25f, -0x1.ffc262p-1f, 0x1.8bd6b8p-14f, 0x1.740c5cp-7f, 0x1.dcf4d2p+2f, 0x1.135586p-4f,
      0x1.3ec566p-3f, 0x1.390808p-1f}},
    {"dielectric_tilted_polar",
     {0x1.9f35e4p-3f, -0x1.53414ep-1f, 0x1.71275cp-1f, 0x1.18676cp-5f, 0x1.f6a678p-4f, 0x1.e674eep-9f, 0x1.191218p-125f,
      -0x1.c76322p+0f, 0x1.14de3ep+2f, 0x1.9af214p-36f, 0x1.befa54p-2f, 0x1.53d95ep-105f}},
    {"reflection_concentric",
     {0x1.fb43ap-2f, 0x1.bbf22ep-1f, 0x1.578242p-5f, 0x1.6fce2ap-1f, 0x1.01e49ep-10f, 0x1.2e9bc2p-2f, 0x1.68a6fep-10f}},
    {"reflection_bounded_concentric",
     {0x1.eba1d4p-1f, -0x1.8c7976p-13f, 0x1.1ae848p-2f, 0x1.77fbbap-20f, 0x1.87786ap-3f, 0x1.b30f44p-22f,
      0x1.fd0054p-2f}},
    {"reflection_turned_concentric",
     {0x1.fffffcp-1f, 0x1.ea3eep-12f, 0x1.58b71p-62f, 0x1.7bf7a6p+1f, 0x1.0e0ebap-11f, 0x1.8e7a6p-13f, 0x1.fe7eaep-1f,
      0x1.5ff4c6p-90f}},
    {"reflection_tilted_concentric",
     {0x1.ffee92p-1f, 0x1.2e9818p-13f, 0x1.8b2c36p-6f, 0x1.74805p-1f, 0x1.18c6fp-2f, -0x1.5033ccp+1f, 0x1.6e4792p+0f,
      -0x1.81914ap-1f, 0x1.75918p-10f, 0x1.22a81p-1f}},
    {"dielectric_concentric",
     {0x1.0f0d76p-1f, 0x1.b25deap-1f, -0x1.52fa9ap-22f, 0x1.e623d4p-2f, 0x1.417e1p-4f, 0x1.d5206cp-3f, 0x1.7bcafap-4f,
      0x1.7f62a2p-7f, 0x1.98fcbcp-46f}},
    {"dielectric_tilted_concentric",
     {-0x1.7fbea2p-3f, -0x1.aaf828p-1f, 0x1.09c6ecp-1f, 0x1.0c2bf4p-20f, 0x1.ec443ep-1f, -0x1.f1805cp+0f,
      -0x1.9dbdcp-14f, -0x1.502486p+0f, 0x1.001006p+0f, 0x1.5e5c7p-2f, 0x1.eff93ap-42f, 0x1.d70bp-3f}},
    {"reflection_spherical_cap",
     {0x1.ffff12p-1f, 0x1.c0213ep-6f, 0x1.ed6d02p-9f, 0x1.f7c344p-1f, 0x1.eb7d0cp-11f, 0x1.39446ap-12f,
      0x1.e6c804p-2f}},
    {"reflection_bounded_spherical_cap",
     {0x1.66af2p-1f, 0x1.85b4p-4f, 0x1.69dd58p-1f, 0x1.1148cap-3f, 0x1.5fb266p-10f, 0x1.f43e14p-16f, 0x1.78cd36p-116f}},
    {"reflection_turned_spherical_cap",
     {0x1.b7150cp-5f, 0x1.aeba66p-6f, 0x1.ff038ep-1f, 0x1.5a1cfap-1f, 0x1.b8f882p-1f, 0x1.654464p-118f, 0x1.8b273p-3f,
      0x1.618134p-19f}},
    {"reflection_tilted_spherical_cap",
     {0x1.e7bb14p-1f, -0x1.378798p-2f, 0x1.49a5c2p-14f, 0x1.229746p-2f, 0x1.50a8f4p-3f, 0x1.b6537p-5f, -0x1.aeb6f4p-1f,
      0x1.83dd92p+1f, 0x1.e718fp-25f, 0x1.84d53ap-4f}},
    {"dielectric_spherical_cap",
     {-0x1.4fbe9ep-6f, 0x1.315f66p-3f, 0x1.fa2af8p-1f, 0x1.6bd47cp-4f, 0x1.89249cp-18f, 0x1.4eae6cp-3f, 0x1.d94f3cp-10f,
      0x1.be8842p-3f, 0x1.858fep-1f}},
    {"dielectric_tilted_spherical_cap",
     {-0x1.fb4648p-10f, -0x1.a9566p-11f, 0x1.ffffb6p-1f, 0x1.fdc31cp-8f, 0x1.aa359cp-1f, 0x1.3a2198p+0f,
      0x1.3b3cdep-62f, -0x1.13bba4p+1f, 0x1.ffd866p-1f, 0x1.001df6p-1f, 0x1.32d38cp-64f, 0x1.d7b2eep-6f}},
    {"evaluate_reflection",
     {-0x1.c9ca7ep-30f, 0x1.ffffb4p-1f, 0x1.17664p-9f, 0x1.b17fb6p-23f, 0x1.faea48p-1f, 0x1.1fead2p-3f, 0x1.581c3ap-18f,
      0x1.446ee4p+3f}},
    {"evaluate_reflection_bounded",
     {-0x1.11924ep-1f, 0x1.d9d0ap-2f, 0x1.6a2f28p-1f, 0x1.65cd02p-1f, -0x1.6e0ab4p-1f, 0x1.bbbf46p-11f, 0x1.ffeaaap-1f,
      0x1.ffffb8p-1f}},
    {"evaluate_reflection_tilted",
     {-0x1.fff2fep-1f, -0x1.cb8798p-7f, 0x1.5cc5p-10f, -0x1.0e346p-2f, -0x1.7e2afap-1f, 0x1.38cae4p-1f, 0x1.020304p-14f,
      0x1.02058cp-14f, -0x1.fec59p-4f, -0x1.cc0112p-2f, -0x1.d13e1p-58f}},
    {"evaluate_dielectric_tilted",
     {-0x1.87b7ap-1f, -0x1.c460d8p-2f, 0x1.dfc012p-2f, -0x1.6bf924p-1f, 0x1.b15f64p-2f, 0x1.1f99eep-1f, 0x1.b5ace2p-1f,
      0x1.a18302p-1f, -0x1.20e11ap-1f, 0x1.8e713p+1f, 0x1.bc554ep-1f, 0x1.1948cep-3f}},
    // Zen 3, 2026-11-27, seed 346269909
    {"normals_polar",
     {0x1.b1dad6p-2f, -0x1.b84bcp-10f, 0x1.cfb43p-1f, 0x1.16a5b6p+5f, 0x1.0d4ae4p+4f, 0x1.37d9e8p-24f, 0x1.73ad04p-2f}},
    {"reflection_polar",
     {0x1.fff82ep-1f, 0x1.d6ac86p-58f, 0x1.65f79cp-7f, 0x1.795a2cp+4f, 0x1.46e906p-8f, 0x1.e2cc14p-2f,
      0x1.dd2df6p-27f}},
    {"reflection_bounded_polar",
     {0x1.a23b1p-12f, -0x1.fffffep-1f, 0x1.739ec2p-24f, 0x1.1e1c36p-4f, 0x1.0b1a86p+3f, 0x1.5fae1ap-9f,
      0x1.2ed0b6p-2f}},
    {"dielectric_polar",
     {0x0p+0f, 0x1.a926c6p-1f, 0x1.1d4a2cp-1f, 0x1.9e762ap-3f, 0x1.128408p-4f, 0x1.4247cp-3f, 0x1.e0d404p-2f,
      0x1.acc9a6p-5f, 0x1.67ca58p-68f}},
    {"normals_concentric",
     {-0x1.1ae048p-8f, -0x1.0b90d4p-2f, 0x1.ee3688p-1f, 0x1.8028a8p-12f, 0x1.000482p+0f, 0x1.cfe6eap-12f,
      0x1.b21c82p-11f}},
    {"reflection_concentric",
     {0x1.fffffep-1f, -0x1.5675a2p-18f, 0x1.de6494p-60f, 0x1.9f75bp-3f, 0x1.50e74ep-10f, 0x1.6cc006p-16f,
      0x1.a07bcp-65f}},
    {"reflection_bounded_concentric",
     {-0x1.6a0ap-13f, 0x1.ffff82p-1f, 0x1.65e068p-9f, 0x1.14db08p-9f, 0x1.3336bp+4f, 0x1.e6d468p-1f, 0x1.8b3258p-9f}},
    {"reflection_turned_concentric",
     {0x1.4c393ep-16f, -0x1.2f22b8p-9f, 0x1.ffbfb6p-1f, 0x1.bdccb6p-17f, 0x1.6b7f82p-13f, 0x1.d3d37cp-2f,
      0x1.d26952p-1f, 0x1.d682c2p-5f}},
    {"reflection_tilted_concentric",
     {-0x1.ff8c4cp-1f, 0x1.470b56p-5f, 0x1.ac64f6p-7f, 0x1.fffdfcp-1f, 0x1.faed1ap-17f, -0x1.f158fp-2f, -0x1.2aa4a8p+0f,
      0x1.498fdcp+1f, 0x1.32c26cp-6f, 0x1.c706aep-3f}},
    {"dielectric_concentric",
     {0x1.416534p-7f, 0x1.239514p-28f, 0x1.fff9a2p-1f, 0x1.20cbc6p-12f, 0x1.6e4168p-14f, 0x1.9cd028p-4f, 0x1.7d6064p-3f,
      0x1.f409cap-11f, 0x1.d1abccp-1f}},
    {"dielectric_tilted_concentric",
     {0x1.83a9c6p-4f, -0x1.fd89fp-1f, 0x1.9c64c6p-6f, 0x1.3367c2p-20f, 0x1.fbf088p-1f, 0x1.70056ep-90f, -0x1.38c93ap-1f,
      -0x1.bf34f4p-27f, 0x1.5b57bep-1f, 0x1.9f1b94p-6f, 0x1.2589p-10f, 0x1.33733cp-43f}},
    {"reflection_spherical_cap",
     {0x1.3b8d46p-1f, 0x1.923318p-1f, 0x1.d4da74p-5f, 0x1.b4e7fep-9f, 0x1.a9b5ep-15f, 0x1.f32dbcp-2f, 0x1.dc6c3p-2f}},
    {"reflection_bounded_spherical_cap",
     {-0x1.f2481p-1f, -0x1.503318p-8f, 0x1.d6aec4p-3f, 0x1.168044p+3f, 0x1.709e96p-4f, 0x1.336508p-25f,
      0x1.f7bbcep-1f}},
    {"reflection_turned_spherical_cap",
     {0x1.c44614p-11f, 0x1.31fcf4p-11f, 0x1.000012p+0f, 0x1.3ae28p-8f, 0x1.807e8p-4f, 0x1.b7671ep-11f, 0x1.3798d8p-2f,
      0x1.5d124ap-14f}},
    {"dielectric_spherical_cap",
     {0x1.e54202p-8f, 0x1.8c827ap-8f, 0x1.fffa12p-1f, 0x1.45d6ccp-12f, 0x1.33b268p-19f, 0x1.a0dcbcp-4f, 0x1.157316p-5f,
      0x1.5d07a2p-22f, 0x1.7c525cp-1f}},
    {"dielectric_tilted_spherical_cap",
     {0x1.275432p-8f, -0x1.0a6296p-9f, 0x1.fffe76p-1f, 0x1.0d1efp-20f, 0x1.feb588p-1f, 0x1.88c08cp-21f, -0x1.1bbaa8p-9f,
      0x1.013b9cp+0f, 0x1.b2c6ep-4f, 0x1.fff9fep-2f, 0x1.dbb2dp-55f, 0x1.d540d6p-1f}},
    {"evaluate_reflection",
     {-0x1.ffffe6p-1f, -0x1.ffffdep-26f, 0x1.4db55ep-10f, 0x1.afff7ap-21f, -0x1.fff3eep-1f, 0x1.d3d92p-7f,
      0x1.5016aep-3f, 0x1.437eb2p-3f}},
    {"evaluate_reflection_bounded",
     {0x1.fe1cfep-1f, -0x1.5e988p-4f, 0x1.674932p-8f, 0x1.711ep-6f, -0x1.e6e026p-1f, 0x1.3bfe8ep-2f, 0x1.7cf4c2p-4f,
      0x1.8920b8p-4f}},
    {"evaluate_reflection_turned",
     {0x1.fdf564p-1f, -0x1.5378dp-5f, 0x1.438f3ep-4f, 0x1.8cb08p-7f, 0x1.fff61ap-1f, 0x1.17181ap-9f, 0x1.8b146ap-9f,
      0x1.9b348cp-9f, 0x1.8f85ep-10f}},
    {"evaluate_reflection_tilted",
     {0x1.a21736p-3f, 0x1.26eef6p-3f, 0x1.efbc1p-1f, 0x1.c6ef88p-2f, 0x1.70f414p-1f, 0x1.10892ap-1f, 0x1.6a40cap-1f,
      0x1.f09f16p-1f, -0x1.d89ff8p-4f, -0x1.18896cp-11f, -0x1.19ec12p-21f}},
    {"evaluate_dielectric_tilted",
     {0x1.d979e6p-1f, -0x1.6b473ep-3f, 0x1.58c44ep-2f, 0x1.38099ep-3f, 0x1.83442p-1f, 0x1.45b46cp-1f, 0x1.ffffdap-1f,
      0x1.fff6a4p-1f, 0x1.000f6p+0f, 0x1.d4e6f8p-18f, 0x1.71d9fp-9f, 0x1.9cfb06p-4f}},
    // Zen 5, 2026-11-27. Caps reached 365, 150, 89 and 30 here, where the rim of the cap cancels and where its pole
    // underflows.
    {"normals_spherical_cap",
     {0x1.043f5cp-16f, -0x1.964acep-11f, 0x1.679p-16f, 0x1.0c2ac2p-20f, 0x1.47f34ep+6f, 0x1.b0f7cap-17f,
      0x1.fff56p-1f}},
    {"normals_spherical_cap",
     {0.f, 0.f, 0x1.ffe958p+38f, 0x1.9p+6f, 0x1.54c57ep-17f, 0x1.460172p-15f, 0x1.ffe958p-53f}},
    {"normals_spherical_cap",
     {-0x1.9867dap-1f, 0x1.01b914p+0f, 0x1.912bp-2f, 0x1.4826e8p+6f, 0x1.1f3698p-14f, 0x1.7c63b6p-10f, 0x1.fb5c36p-1f}},
    {"reflection_spherical_cap",
     {-0x1.ffe9cep-1f, 0x1.38ab8cp-8f, 0x1.ad3p-6f, 0x1.0c2ca2p+6f, 0x1.003a82p-13f, 0x1.1eb364p-8f, 0x1.f1ebbp-1f}},
    {"reflection_bounded_spherical_cap",
     {0x1.23c9b2p-11f, -0x1.c0e93ap-12f, 0x1.00001ep+0f, 0x1.a7669cp-1f, 0x1.fe342ap-1f, 0x1.ee20dcp-4f,
      0x1.952292p-21f}},
    {"dielectric_polar",
     {0x1.d6fbdep-2f, 0x1.8d6eb6p-62f, -0x1.c6a0f6p-1f, 0x1.4289ep-2f, 0x1.0be3dap-8f, 0x1.db3b06p+2f, 0x1.ab45fap-2f,
      0x1.87d2b2p-1f, 0x1.f2a334p-1f}},
};

TEST(Found, StaysWithinTheBounds) {
  std::size_t measured = 0;
  for_each_subject([&](const std::string& name, auto subject) {
    using Subject = typename decltype(subject)::type;
    for (const Row& row : kRows)
      if (row.subject == name) {
        ASSERT_EQ(row.in.size(), Subject::kInputs);
        Table columns;
        for (float value : row.in) columns.push_back({value});
        const auto in = inputs_at<Subject::kInputs>(columns, 0);
        ASSERT_TRUE(Subject::in_domain(in)) << name << " at " << describe(in);
        const auto ratios = ratios_of<Subject>(in, Subject::run(columns)[0]);
        for (std::size_t r = 0; r < Subject::kResults; ++r)
          EXPECT_LE(ratios[r], Subject::bounds[r].max)
              << name << ", " << Subject::bounds[r].what << " at " << describe(in);
        ++measured;
      }
  });
  EXPECT_EQ(measured, std::size(kRows));
}

}  // namespace
}  // namespace vndf::ratio
