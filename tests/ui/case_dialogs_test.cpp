/// @file  Cases and exports in the real window: nothing is lost or replaced unasked.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/memory_scan.h"
#include "tests/ui/real_window.h"

namespace flytri {
namespace {

using testing::Names;
using testing::RealWindow;

TEST_F(RealWindow, ExportDialogExportsTheChosenFormats) {
  show("finished");
  EXPECT_EQ(after_click("export"), Names{});
  EXPECT_EQ(window().state()["dialog"], "export");
  EXPECT_EQ(after_click("format_stl"), Names{"ChangeSettings"}) << "the choice is remembered";
  EXPECT_EQ(after_click("format_stl"), Names{"ChangeSettings"});
  EXPECT_EQ(after_key("Return"), Names{"Export"});
  window().key("Escape");
  EXPECT_EQ(window().state()["dialog"], "none");
}

TEST_F(RealWindow, ExportDialogWritesAReportBesideTheModel) {
  show("scanning");
  window().click("export");
  EXPECT_EQ(after_click("report"), Names{}) << "there is no finished model";
  window().key("Escape");
  show("finished");
  window().click("export");
  EXPECT_FALSE(window().state()["export"]["report"]);
  EXPECT_EQ(after_click("report"), Names{"ChangeSettings"}) << "the choice is remembered";
  EXPECT_TRUE(window().state()["export"]["report"]);
  EXPECT_NE(window().state()["hint"].get<std::string>().find("Rivera-2031-upper.html"),
            std::string::npos);
  EXPECT_EQ(after_key("Return"), Names{"Export"});
  EXPECT_EQ(after_click("report"), Names{"ChangeSettings"});
  window().key("Escape");
}

TEST_F(RealWindow, AFinishedModelSaysHowCertainItsDistanceIs) {
  show("scanning");
  EXPECT_FALSE(window().where("span"));
  show("finished");
  EXPECT_TRUE(window().where("span"));
}

TEST_F(RealWindow, ExportDialogAsksBeforeItReplacesFiles) {
  show("finished");
  window().click("export");
  EXPECT_FALSE(window().where("open_folder")) << "nothing is exported yet";
  EXPECT_EQ(after_click("confirm"), Names{"Export"});
  EXPECT_FALSE(window().where("open_folder"));
  EXPECT_EQ(after_click("confirm"), Names{"Export"});
  ASSERT_TRUE(window().where("open_folder")) << "the second Export allows to replace";
  EXPECT_EQ(after_click("open_folder"), Names{"OpenExportFolder"});
  EXPECT_EQ(after_key("ctrl+o"), Names{"OpenExportFolder"});
}

TEST_F(RealWindow, AnotherNameIsAskedForAgain) {
  show("export_exists");
  window().click("export");
  window().click("export_name");
  window().type("2");
  EXPECT_EQ(after_click("confirm"), Names{"Export"});
  EXPECT_FALSE(window().where("open_folder")) << "the files of the new name were never asked for";
  EXPECT_EQ(after_click("confirm"), Names{"Export"});
  EXPECT_TRUE(window().where("open_folder"));
}

TEST_F(RealWindow, TypedTextSendsNoCommand) {
  show("empty_case");
  window().key("d");
  EXPECT_EQ(window().state()["dialog"], "case");
  window().click("patient");
  (void)window().commands();
  window().type("Zoe Finch");
  EXPECT_EQ(window().commands(), Names{});
  EXPECT_EQ(after_click("confirm"), Names{"NewCase"});
  window().ask("wait 2");
  EXPECT_EQ(window().state()["dialog"], "none");
}

TEST_F(RealWindow, TabMovesBetweenTheFieldsOfACaseAndEnterCreatesIt) {
  show("empty_case");
  window().key("d");
  window().type("Zoe Finch");
  window().key("Tab");
  window().type("12.3.84");
  window().key("Tab");
  window().type("77");
  const nlohmann::json form = window().state()["case_form"];
  EXPECT_EQ(form["patient"], "Zoe Finch");
  EXPECT_EQ(form["birth_date"], "12.3.84");
  EXPECT_EQ(form["number"], "77");
  (void)window().commands();
  EXPECT_EQ(after_key("Return"), Names{}) << "that is no date";
  window().click("birth_date");
  window().key("ctrl+a");
  window().type("1984-03-12");
  EXPECT_EQ(after_key("Return"), Names{"NewCase"}) << window().state()["case_form"];
  window().ask("wait 2");
  EXPECT_EQ(window().state()["dialog"], "none");
}

TEST_F(RealWindow, APassphraseIsTypedTwice) {
  show("empty_case");
  window().key("d");
  window().type("Zoe Finch");
  window().click("passphrase");
  window().type("secret");
  EXPECT_EQ(window().state()["case_form"]["path"].get<std::string>().find("Zoe"), std::string::npos)
      << "an encrypted case does not name its patient";
  EXPECT_EQ(after_click("confirm"), Names{});
  window().click("passphrase_again");
  window().type("secret");
  EXPECT_EQ(after_key("Return"), Names{"NewCase"}) << window().state()["case_form"];
}

TEST_F(RealWindow, APassphraseLeavesNoCopyInMemory) {
  if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  const Secret passphrase = testing::random_passphrase();
  const std::string text(passphrase.view());
  const auto copies = [&] { return testing::unlocked_copies(window().process(), passphrase); };
  window().ask("do cancel");
  show("empty_case");
  window().key("d");
  window().click("passphrase");
  window().type(text);
  window().key("Tab");
  window().type(text);
  EXPECT_EQ(after_key("Return"), Names{"NewCase"}) << window().state()["case_form"];
  window().ask("wait 5");
  EXPECT_EQ(copies(), Names{}) << "after a new case";

  window().ask("do cancel");
  show("unnamed");
  window().key("d");
  window().click("tab_open");
  window().click("passphrase");
  window().type(text);
  window().key("Escape");
  window().ask("wait 5");
  EXPECT_EQ(copies(), Names{}) << "after the dialog was closed";
}

TEST_F(RealWindow, TheListOfCasesIsSearched) {
  show("unnamed");
  window().key("d");
  window().click("tab_open");
  window().type("chidi");
  const std::string path = window().state()["case_form"]["path"];
  EXPECT_NE(path.find("Okafor"), std::string::npos);
  EXPECT_EQ(after_key("Return"), Names{"OpenCase"});
}

TEST_F(RealWindow, AnUnnamedCaseIsDiscardedOnlyAfterAQuestion) {
  show("unnamed");
  window().key("d");
  window().click("tab_open");
  window().click("known_1");
  EXPECT_EQ(after_click("discard"), Names{});
  window().key("Escape");
  EXPECT_EQ(window().state()["dialog"], "case") << "Escape takes the question back";
  window().click("discard");
  EXPECT_EQ(after_click("confirm"), Names{"DiscardCase"});
}

TEST_F(RealWindow, ADamagedCaseSaysSoAndOffersARescueCopy) {
  show("damaged");
  EXPECT_EQ(after_key("space"), Names{}) << "nothing can be saved in it";
  window().key("d");
  EXPECT_EQ(window().state()["case_form"]["path"], "/home/clinic/cases/Rivera-2031-rescued.flytri");
  EXPECT_EQ(after_click("confirm"), Names{"SaveRescueCopy"});
  window().click("tab_open");
  EXPECT_EQ(after_click("confirm"), Names{"OpenCase"}) << "another case can be opened";
  window().click("tab_fields");
  window().type("2");
  EXPECT_EQ(after_key("Return"), Names{"SaveRescueCopy"});
}

TEST_F(RealWindow, AStageIsClearedOnlyAfterAQuestionAndUndoBringsItBack) {
  show("scanning");
  EXPECT_EQ(after_key("ctrl+Delete"), Names{"PauseScan"});
  EXPECT_EQ(window().state()["dialog"], "question");
  EXPECT_EQ(after_key("Escape"), Names{});
  EXPECT_EQ(window().state()["dialog"], "none");
  show("paused");
  window().key("t");
  EXPECT_EQ(after_click("clear_stage"), Names{}) << "the button asks, too";
  EXPECT_EQ(window().state()["tool"], "none");
  EXPECT_EQ(after_click("confirm"), Names{"ClearStage"});
  EXPECT_EQ(window().state()["dialog"], "none");
  show("cleared");
  EXPECT_EQ(after_key("ctrl+Delete"), Names{}) << "it is empty";
  EXPECT_EQ(after_key("z"), Names{"BringBackStage"});
  EXPECT_EQ(after_click("undo"), Names{"BringBackStage"});
  EXPECT_EQ(after_key("ctrl+b"), Names{"BringBackStage"});
}

TEST_F(RealWindow, AModelThatWasNotExportedIsReplacedOnlyAfterAQuestion) {
  show("finished");
  EXPECT_EQ(after_key("space"), Names{});
  EXPECT_EQ(window().state()["dialog"], "question");
  EXPECT_EQ(after_key("Return"), Names{"ResumeScan"});
  show("exported");
  EXPECT_EQ(after_key("space"), Names{"ResumeScan"}) << "the files have the model";
}

TEST_F(RealWindow, WhatIsNotSavedIsLeftOnlyAfterAQuestion) {
  show("not_saved");
  EXPECT_EQ(after_key("ctrl+q"), Names{});
  EXPECT_EQ(window().state()["dialog"], "question");
  window().key("Escape");
  window().key("d");
  window().click("tab_open");
  window().click("known_2");
  (void)window().commands();
  EXPECT_EQ(after_click("confirm"), Names{});
  EXPECT_EQ(window().state()["dialog"], "question");
  EXPECT_EQ(after_click("confirm"), Names{"OpenCase"});
  EXPECT_EQ(window().state()["dialog"], "case") << "it says what becomes of it";
}

TEST_F(RealWindow, AnExportThatIsBeingWrittenIsLeftOnlyAfterAQuestion) {
  show("exporting");
  EXPECT_EQ(after_key("ctrl+q"), Names{});
  EXPECT_EQ(window().state()["dialog"], "question");
  window().key("Escape");
  EXPECT_EQ(window().state()["dialog"], "none");
  show("exported");
  EXPECT_NE(window().state()["dialog"], "question") << "nothing is lost any more";
}

TEST_F(RealWindow, ScanningPausesBehindTheDialogOfCases) {
  show("scanning");
  EXPECT_EQ(after_key("d"), Names{"PauseScan"});
}

class StagesWindow : public RealWindow {
 protected:
  static nlohmann::json state() { return window().state(); }
};

TEST_F(StagesWindow, AJawIsKeptAsPreopAndItsToothIsCutOutNext) {
  show("paused");
  EXPECT_FALSE(window().where("scan_upper-preop")) << "there is no such scan yet";
  EXPECT_EQ(after_click("stages"), Names{});
  EXPECT_EQ(state()["dialog"], "stages");
  EXPECT_TRUE(window().where("copy_upper-preop"));
  EXPECT_TRUE(window().where("copy_upper-scanbody"));
  EXPECT_FALSE(window().where("copy_upper")) << "a jaw is no copy of itself";
  EXPECT_FALSE(window().where("copy_lower-preop"));
  EXPECT_EQ(after_click("copy_upper-preop"), Names{"CopyStage"});
  EXPECT_EQ(state()["dialog"], "none");
  EXPECT_EQ(state()["tool"], "trim") << "the jaw goes on";
}

TEST_F(StagesWindow, ACopyIsOpenedWithTheToolToTrim) {
  show("paused");
  window().key("F6");
  EXPECT_EQ(after_click("copy_upper-scanbody"), Names{"CopyStage"});
  EXPECT_EQ(state()["tool"], "none") << "the jaw stays as it is";
  show("scan_body");
  EXPECT_EQ(state()["tool"], "trim");
}

TEST_F(StagesWindow, TheScansOfAJawAreChosenBesideTheLiveImage) {
  show("scan_body");
  for (const char* id : {"scan_upper", "scan_upper-preop"})
    EXPECT_EQ(after_click(id), Names{"SelectStage"}) << id;
  EXPECT_EQ(after_key("F1"), Names{"SelectStage"});
  window().key("F6");
  EXPECT_FALSE(window().where("copy_upper-preop")) << "it is not empty";
  EXPECT_EQ(after_click("open_upper-preop"), Names{"SelectStage"});
  EXPECT_EQ(state()["dialog"], "none");
  show("scanning");
  EXPECT_FALSE(window().where("stages")) << "the image has the room";
  EXPECT_EQ(after_key("F6"), Names{"PauseScan"});
}

TEST_F(StagesWindow, NothingIsCopiedThatCannotBe) {
  for (const char* name : {"ready", "damaged", "not_saved"}) {
    show(name);
    window().key("F6");
    EXPECT_EQ(state()["dialog"], "stages") << name;
    EXPECT_FALSE(window().where("copy_upper-preop")) << name;
    EXPECT_TRUE(window().where("open_upper-preop")) << name;
    window().key("Escape");
  }
  show("bite");
  window().key("F6");
  EXPECT_EQ(state()["dialog"], "none");
  show("finishing");
  window().key("F6");
  EXPECT_EQ(state()["dialog"], "none");
}

}  // namespace
}  // namespace flytri
