#include "app/session/export_name.h"

#include <gtest/gtest.h>

namespace flytri::session {
namespace {

ui::CaseState case_of(const std::string& patient, const std::string& number) {
  ui::CaseState file;
  file.path = "/home/clinic/cases/a.flytri";
  file.fields.patient_name = patient;
  file.fields.patient_id = number;
  return file;
}

std::string name_of(const ui::CaseState& file) {
  return proposed_export_name(file, io::ScanStage::kLower, "2026-11-21");
}

TEST(ExportName, IsOfPatientNumberAndStage) {
  EXPECT_EQ(name_of(case_of("Ana Rivera", "2031")), "Ana-Rivera-2031-lower");
  EXPECT_EQ(name_of(case_of("Ana Rivera", "")), "Ana-Rivera-lower");
  EXPECT_EQ(name_of(case_of("", "2031")), "2031-lower");
  EXPECT_NE(name_of(case_of("Ana Rivera", "2031")), name_of(case_of("Ana Rivera", "2032")));
}

TEST(ExportName, OfAnEncryptedCaseHoldsNoPatientsName) {
  ui::CaseState file = case_of("Ana Rivera", "2031");
  file.is_encrypted = true;
  EXPECT_EQ(name_of(file), "2031-lower");
  file.fields.patient_id.clear();
  EXPECT_EQ(name_of(file), "scan-2026-11-21-lower");
}

TEST(ExportName, WithoutACaseIsOfTheDate) {
  ui::CaseState file = case_of("Ana Rivera", "2031");
  file.path.clear();
  EXPECT_EQ(name_of(file), "scan-2026-11-21-lower");
  EXPECT_EQ(name_of(case_of("", "")), "scan-2026-11-21-lower");
}

TEST(ExportName, KeepsTheLettersOfAllScripts) {
  for (const char* letters : {"Zoë", "Müller", "Ångström", "Łukasz", "Ελένη", "Дмитрий", "田中",
                              "김민수", "عمر", "e\u0301", "a_b", "Meyer-Otto"}) {
    EXPECT_EQ(file_name_part(letters), letters);
  }
}

TEST(ExportName, HoldsNothingThatLeavesTheFolderOrHides) {
  EXPECT_EQ(file_name_part("../../etc/passwd"), "etc-passwd");
  EXPECT_EQ(file_name_part("a\\b:c*d?e\"f<g>h|i"), "a-b-c-d-e-f-g-h-i");
  EXPECT_EQ(file_name_part("a\n\tb\x1b[31m"), "a-b-31m");
  EXPECT_EQ(file_name_part(".hidden"), "hidden");
  EXPECT_EQ(file_name_part("~root"), "root");
  // Right-to-left override, zero-width space, slash in full width, line separator.
  EXPECT_EQ(file_name_part("a\u202eb\u200bc\uff0fd\u2028e"), "a-b-c-d-e");
  EXPECT_EQ(file_name_part("a\xff\xc3"), "a");
  EXPECT_EQ(file_name_part("..."), "");
}

TEST(ExportName, IsCutBetweenLetters) {
  std::string long_name;
  for (int i = 0; i < 200; ++i) long_name += "ü";
  const std::string part = file_name_part(long_name);
  EXPECT_EQ(part.size(), 80U);
  EXPECT_EQ(part, long_name.substr(0, 80));
}

}  // namespace
}  // namespace flytri::session
