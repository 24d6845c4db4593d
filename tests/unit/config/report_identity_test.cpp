// The table [report] of session and fit files.

#include "config/report_identity.hpp"

#include <gtest/gtest.h>

#include "config/fit_settings.hpp"
#include "config/session_settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

constexpr const char* kBlade =
    "[report]\npart = \"Fan\"\nserial = \"7 <b>\"\noperator = \"Müller\"\n[report.fields]\nheat = \"H1\"\n\"a b\" = "
    "\"c\"\n";

Failure identity_of(const std::string& text, ReportIdentity& identity) {
  const testing::ScratchFolder folder;
  return load_report_identity(folder.write("a.toml", text), identity);
}

TEST(ReportIdentity, IsReadFromFitAndSessionFiles) {
  const testing::ScratchFolder folder;
  const std::string path = folder.write("a.toml", kBlade);
  ReportIdentity identity;
  ASSERT_EQ(load_report_identity(path, identity).message, "");
  EXPECT_EQ(identity.part, "Fan");
  EXPECT_EQ(identity.operated_by, "Müller");
  EXPECT_EQ(identity.fields, (std::vector<std::pair<std::string, std::string>>{{"a b", "c"}, {"heat", "H1"}}));
  SessionSettings session;
  ASSERT_EQ(load_session(path, session).message, "");
  EXPECT_EQ(session.report.serial, "7 <b>");
  FitSettings fit;
  EXPECT_EQ(load_fit(path, fit).message, "");
}

TEST(ReportIdentity, WhatCannotStandInAReportIsRefusedWithItsKey) {
  ReportIdentity identity;
  EXPECT_NE(identity_of("[report]\nserail = \"7\"\n", identity).message.find("did you mean"), std::string::npos);
  EXPECT_NE(identity_of("[report]\npart = \"a\\nb\"\n", identity).message.find("report.part"), std::string::npos);
  EXPECT_NE(identity_of("[report]\npart = \"" + std::string(201, 'x') + "\"\n", identity).message.find("200"),
            std::string::npos);
  EXPECT_NE(identity_of("[report.fields]\nheat = 5\n", identity).message.find("heat"), std::string::npos);
  std::string many = "[report.fields]\n";
  for (int k = 0; k < 25; ++k) many += "f" + std::to_string(k) + " = \"x\"\n";
  EXPECT_NE(identity_of(many, identity).message.find("24 fields"), std::string::npos);
  EXPECT_TRUE(identity.empty());
}

TEST(ReportIdentity, AFitFileWithAWrongTableIsRefused) {
  const testing::ScratchFolder folder;
  FitSettings fit;
  EXPECT_NE(load_fit(folder.write("a.toml", "[report]\nparts = \"x\"\n"), fit).message.find("did you mean"),
            std::string::npos);
}

}  // namespace
}  // namespace bladefit
