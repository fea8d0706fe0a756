#include "app/text/error_text.h"

#include <QTest>
#include <sstream>

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
};

}  // namespace zerodrift

QTEST_GUILESS_MAIN(zerodrift::ErrorTextTest)
#include "error_text_test.moc"
