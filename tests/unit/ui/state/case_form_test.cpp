#include "ui/state/case_form.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

CaseForm form_of(const std::string& patient, const std::string& number) {
  CaseForm form;
  form.fields.patient_name = patient;
  form.fields.patient_id = number;
  return form;
}

TEST(CaseForm, ProposesAFileNamedAfterThePatient) {
  CaseState file;
  file.folder = "/cases";
  EXPECT_EQ(proposed_path(file, form_of("Zoë/..", "12")), "/cases/Zoë----12.flytri");
  EXPECT_EQ(proposed_path(file, form_of("", "")), "/cases/case.flytri");
}

TEST(CaseForm, ProposesNoFileThatExists) {
  CaseState file;
  file.folder = "/cases";
  file.known = {{"/cases/Smith.flytri", "Smith", "", false},
                {"/cases/Smith-2.flytri", "Smith", "", false}};
  EXPECT_EQ(proposed_path(file, form_of("Smith", "")), "/cases/Smith-3.flytri");
}

TEST(CaseForm, TheFileOfAnEncryptedCaseDoesNotNameThePatient) {
  CaseState file;
  file.folder = "/cases";
  CaseForm form = form_of("Smith", "12");
  form.passphrase = Secret("secret");
  EXPECT_EQ(proposed_path(file, form), "/cases/12.flytri");
  form.fields.patient_id.clear();
  EXPECT_EQ(proposed_path(file, form), "/cases/case.flytri");
}

TEST(CaseForm, ChecksDates) {
  for (const char* date : {"1984-03-12", "2024-02-29"}) EXPECT_TRUE(is_date(date)) << date;
  for (const char* wrong : {"", "12.3.1984", "1984-3-12", "1984-13-01", "2023-02-29", "1984-03-1x"})
    EXPECT_FALSE(is_date(wrong)) << wrong;
  CaseForm form;
  form.path = "a.flytri";
  EXPECT_EQ(problem_of(form), std::nullopt);
  form.fields.birth_date = "12.3.1984";
  EXPECT_EQ(problem_of(form), Text::kWriteDate);
}

TEST(CaseForm, ANewPassphraseIsTypedTwice) {
  CaseForm form;
  form.path = "a.flytri";
  form.passphrase = Secret("secret");
  EXPECT_EQ(problem_of(form), Text::kPassphrasesDiffer);
  form.passphrase_again = Secret("secret");
  EXPECT_EQ(problem_of(form), std::nullopt);
  form.tab = CaseTab::kOpen;
  form.passphrase_again.clear();
  EXPECT_EQ(problem_of(form), std::nullopt);
}

TEST(CaseForm, SearchFindsAllWordsAnywhere) {
  std::vector<KnownCase> known = {{"/cases/a.flytri", "Ana Rivera", "2026-11-23 10:42", false},
                                  {"/cases/b.flytri", "Chidi Okafor", "2026-11-22 09:15", false},
                                  {"/cases/17.flytri", "", "2026-11-22 16:30", true}};
  known[1].number = "2030";
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ(matching_cases(known, ""), (Indices{0, 1, 2}));
  EXPECT_EQ(matching_cases(known, "rivera ANA"), Indices{0});
  EXPECT_EQ(matching_cases(known, "2030"), Indices{1});
  EXPECT_EQ(matching_cases(known, "11-22"), (Indices{1, 2}));
  EXPECT_EQ(matching_cases(known, "nobody"), Indices{});
}

}  // namespace
}  // namespace flytri::ui
