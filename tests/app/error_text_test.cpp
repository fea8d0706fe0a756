#include "app/text/error_text.h"

#include <QTest>
#include <sstream>

#include "app/text/core_text.h"

namespace zerodrift {

class ErrorTextTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  // Each code has a sentence and a remedy, uses just the facts it declares, and leaves no brace unfilled.
  void everyCodeHasWords() {
    for (int i = 0; i < error_code_count(); ++i) {
      const auto code = static_cast<ErrorCode>(i);
      Error error{code, {}};
      std::istringstream keys{std::string(context_keys_of(code))};
      for (std::string key; keys >> key;) error.context[key] = "<" + key + ">";
      const ErrorText text = textOf(error);
      const QString all = text.sentence + text.remedy;
      QVERIFY2(!text.remedy.isEmpty(), name_of(code).data());
      QVERIFY2(!all.contains('{') && !all.contains(" - "), qPrintable(all));
      for (const auto& [key, value] : error.context) {
        QVERIFY2(all.contains(QString::fromStdString(value)),
                 qPrintable(QStringLiteral("%1 does not say %2").arg(all, QString::fromStdString(key))));
      }
    }
  }

  /// In the window nobody writes a header map: the dialogs' tables are it.
  void noRemedyInTheWindowSpeaksOfAHeaderMap() {
    for (int i = 0; i < error_code_count(); ++i) {
      const QString remedy = textOf({static_cast<ErrorCode>(i), {}}, Reader::window).remedy;
      QVERIFY(!remedy.isEmpty());
      for (const char* word : {"header map", "column map", "--map"})
        QVERIFY2(!remedy.contains(word), qPrintable(remedy));
    }
  }

  /// What stands in the gap may end a sentence by itself.
  void noSentenceEndsTwice() {
    const auto ending = [](const char* reason) {
      return textOf({ErrorCode::calibration_refused, {{"reason", reason}}}).sentence;
    };
    QCOMPARE(ending("is it in mm?"), QStringLiteral("The calibration is refused: is it in mm?"));
    QCOMPARE(ending("It is not."), QStringLiteral("The calibration is refused: It is not."));
    QCOMPARE(ending("it is not"), QStringLiteral("The calibration is refused: it is not."));
  }

  /// Why something failed may itself be an error: nobody reads its code.
  void anErrorInsideAnotherIsSaid() {
    const Error silent{ErrorCode::machine_silent, {{"timeout_ms", "1000"}, {"what", "reading"}}};
    const ErrorText text = textOf({ErrorCode::upload_restored, {{"reason", describe(silent)}}});
    QCOMPARE(text.sentence, QStringLiteral("The upload failed (No answer came within 1000 ms (reading)); "
                                           "the old table was restored and read back."));
    QCOMPARE(coreText("the ramp could not be watched: " + describe(silent)),
             QStringLiteral("the ramp could not be watched: No answer came within 1000 ms (reading)"));
    QCOMPARE(coreText(std::string("a = b: c=d")), QStringLiteral("a = b: c=d"));
  }
};

}  // namespace zerodrift

QTEST_GUILESS_MAIN(zerodrift::ErrorTextTest)
#include "error_text_test.moc"
