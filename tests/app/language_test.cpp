// The texts of the window: all translated, none missing in the translation file, core's phrases among them.

#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <QTranslator>
#include <QXmlStreamReader>
#include <fstream>
#include <regex>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "app/text/happening_text.h"
#include "core/controller/register_names.h"
#include "core/diagnosis/answer/sentences.h"
#include "core/physics/effects/effect.h"

namespace zerodrift {
namespace {

const QString root = QStringLiteral(ZERODRIFT_SOURCE_DIR);
const QString chinese_file = root + QStringLiteral("/resources/translations/zerodrift_zh_CN.ts");
const QString english_file = root + QStringLiteral("/resources/translations/zerodrift_en.ts");

struct Message {
  QString context;
  QString source;
  QString comment;
  QStringList translations;
  bool finished = true;

  QString key() const { return context + QChar('\n') + source + QChar('\n') + comment; }
};

QVector<Message> messages_of(const QString& path) {
  QFile file(path);
  QVector<Message> messages;
  if (!file.open(QIODevice::ReadOnly)) return messages;
  QXmlStreamReader xml(&file);
  QString context;
  while (!xml.atEnd()) {
    if (!xml.readNextStartElement()) continue;
    const auto name = xml.name();
    if (name == QStringLiteral("name")) context = xml.readElementText();
    if (name == QStringLiteral("message")) messages.append({context, {}, {}, {}});
    if (messages.isEmpty()) continue;
    Message& now = messages.last();
    if (name == QStringLiteral("source")) now.source = xml.readElementText();
    if (name == QStringLiteral("comment")) now.comment = xml.readElementText();
    if (name == QStringLiteral("numerusform")) now.translations << xml.readElementText();
    if (name != QStringLiteral("translation")) continue;
    now.finished = !xml.attributes().hasAttribute(QStringLiteral("type"));
    const QString text = xml.readElementText(QXmlStreamReader::IncludeChildElements);
    if (!text.trimmed().isEmpty() || !now.source.trimmed().isEmpty()) now.translations << text;
  }
  return messages;
}

QStringList gaps_of(const QString& text) {
  static const QRegularExpression gap(QStringLiteral("%\\d|%n|\\{[@+]?\\w+\\}"));
  QStringList gaps;
  for (auto at = gap.globalMatch(text); at.hasNext();) gaps << at.next().captured();
  gaps.sort();
  return gaps;
}

/// String literals of a source without its comments, neighbours joined.
std::vector<std::string> literals_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> literals;
  std::string line;
  std::string joined;
  bool open = false;  // the last thing seen was a literal
  while (std::getline(file, line)) {
    if (line.rfind("#include", 0) == 0) continue;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line.compare(i, 2, "//") == 0) break;
      if (line[i] == '\'' && i + 2 < line.size() && (line[i + 2] == '\'' || line[i + 1] == '\\')) {
        i += line[i + 1] == '\\' ? 3 : 2;
        open = false;
        continue;
      }
      if (line[i] == '"') {
        if (!open && !joined.empty()) literals.push_back(std::exchange(joined, {}));
        for (++i; i < line.size() && line[i] != '"'; ++i) {
          if (line[i] == '\\') ++i;
          joined += line[i];
        }
        open = true;
      } else if (!std::isspace(static_cast<unsigned char>(line[i]))) {
        open = false;
      }
    }
  }
  if (!joined.empty()) literals.push_back(joined);
  return literals;
}

/// Words with a blank between them, as people write; not SQL, a list of columns or the head of a file.
bool looks_like_words(const std::string& text) {
  static const std::regex words("[a-z]{2,},? [a-z(]|[a-z]{2,} \\{");
  static const std::regex other("^(SELECT|INSERT|CREATE|UPDATE|DELETE|PRAGMA|ALTER|DROP)|<\\w+|\\\\n|=\"");
  return std::regex_search(text, words) && !std::regex_search(text, other);
}

/// What only files and the command line show.
bool is_shown_to_nobody(const std::string& text) {
  static const std::array<const char*, 5> texts = {
      "position_mm,error_um or target_mm,measured_mm or target_mm,direction,run,measured_mm",
      "one: --machine M.json (diagnose --machine M.json --recording R.csv --refined M2.json makes a better one from a "
      "recording)",
      "auto, mlr, ridge, pcr, lasso, robust, dynamic, arx, greybox or physics",
      "; error = actual - commanded; written +error: a positive value moves the axis in the negative directionn",
      "; error = actual - commanded; written +error, in mm and mm/mm. Call it whenever the temperatures are new.n"};
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

/// A text with its gaps taken out, in pieces.
QStringList pieces_of(QString text) {
  static const QRegularExpression gap(QStringLiteral("%\\d|\\{[^}]*\\}"));
  QStringList pieces = text.split(gap);
  for (QString& piece : pieces) piece = piece.trimmed();
  pieces.removeAll(QString());
  return pieces;
}

/// Whether some phrase has all the pieces, in this order.
bool covered(const std::string& literal, const QStringList& phrases) {
  const QStringList pieces = pieces_of(QString::fromStdString(literal));
  return std::any_of(phrases.begin(), phrases.end(), [&](const QString& phrase) {
    qsizetype from = 0;
    for (const QString& piece : pieces) {
      const auto at = phrase.indexOf(piece, from);
      if (at < 0) return false;
      from = at + piece.size();
    }
    return true;
  });
}

}  // namespace

class LanguageTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void everyTextIsTranslated_data() {
    QTest::addColumn<QString>("file");
    QTest::newRow("Chinese") << chinese_file;
    QTest::newRow("English plurals") << english_file;
  }

  void everyTextIsTranslated() {
    QFETCH(QString, file);
    const auto messages = messages_of(file);
    QVERIFY(!messages.isEmpty());
    for (const Message& message : messages) {
      const QByteArray which = (message.context + QStringLiteral(": ") + message.source).toUtf8();
      QVERIFY2(message.finished && !message.translations.isEmpty(), which.constData());
      for (const QString& translation : message.translations) {
        QVERIFY2(!translation.isEmpty(), which.constData());
        QStringList wanted = gaps_of(message.source);
        if (file == english_file) wanted.removeAll(QStringLiteral("%n"));  // "one" may do without the number
        for (const QString& gap : wanted) {
          QVERIFY2(translation.contains(gap), (which + " loses " + gap.toUtf8()).constData());
        }
      }
    }
  }

  // What lupdate finds in the sources is what the file holds: nothing new, nothing gone.
  void nothingIsMissingOrLeftOver() {
    QTemporaryDir folder;
    const QString copy = folder.filePath(QStringLiteral("zerodrift_zh_CN.ts"));
    QVERIFY(QFile::copy(chinese_file, copy));
    QProcess lupdate;
    lupdate.setWorkingDirectory(root);
    QStringList arguments = {"-silent", "-no-obsolete", "-locations", "none", "-I", "."};
    arguments += QStringLiteral(ZERODRIFT_TRANSLATED_FOLDERS).split(QLatin1Char(','));
    arguments += {"-source-language", "en", "-target-language", "zh_CN", "-ts", copy};
    lupdate.start(QStringLiteral(ZERODRIFT_LUPDATE), arguments);
    QVERIFY2(lupdate.waitForFinished(60000) && lupdate.exitCode() == 0, lupdate.readAllStandardError().constData());
    QSet<QString> before;
    QSet<QString> now;
    for (const Message& message : messages_of(chinese_file)) before.insert(message.key());
    for (const Message& message : messages_of(copy)) now.insert(message.key());
    QVERIFY(now.size() > 1000);
    const auto news = now - before;
    const auto gone = before - now;
    QVERIFY2(news.isEmpty(), qPrintable(QStringLiteral("Not in the translation file:\n") + news.values().join("\n\n")));
    QVERIFY2(gone.isEmpty(), qPrintable(QStringLiteral("No longer in the sources:\n") + gone.values().join("\n\n")));
  }

  // Core's own texts: each literal that reads like words is a phrase, or is listed as shown to nobody.
  void corePhrasesCoverCore() {
    QStringList phrases;
    for (const char* phrase : corePhrases()) phrases << QString::fromUtf8(phrase);
    QStringList missing;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(ZERODRIFT_SOURCE_DIR "/core")) {
      const std::string path = entry.path().generic_string();
      // The report has a catalogue of its own; of an effect people read its name and its fingerprint.
      if (entry.path().extension() != ".cpp" || path.find("/core/report/") != std::string::npos ||
          path.find("/physics/effects/") != std::string::npos) {
        continue;
      }
      for (const std::string& literal : literals_of(entry.path())) {
        if (!looks_like_words(literal) || is_shown_to_nobody(literal) || covered(literal, phrases)) continue;
        missing << QString::fromStdString(entry.path().filename().string() + ": " + literal);
      }
    }
    QVERIFY2(missing.isEmpty(), qPrintable(missing.join(QLatin1Char('\n'))));
  }

  void sentencesOfTheDiagnosisArePhrases() {
    QSet<QString> phrases;
    for (const char* phrase : corePhrases()) phrases.insert(QString::fromUtf8(phrase));
    for (const std::string& text : diagnosis::sentence_texts()) {
      QVERIFY2(phrases.contains(QString::fromStdString(text)), text.c_str());
    }
  }

  /// Of the program's own register names, in the map on the machine page.
  void meaningsOfRegistersAreSaidInChinese() {
    QTranslator translator;
    QVERIFY(translator.load(QStringLiteral(ZERODRIFT_CHINESE_QM)));
    QCoreApplication::installTranslator(&translator);
    for (const auto& one : controller::register_names()) {
      const std::string meaning(one.meaning);
      QVERIFY2(coreText(meaning) != QString::fromStdString(meaning), meaning.c_str());
    }
    QCoreApplication::removeTranslator(&translator);
  }

  void fingerprintsOfEffectsArePhrases() {
    QSet<QString> phrases;
    for (const char* phrase : corePhrases()) phrases.insert(QString::fromUtf8(phrase));
    QVERIFY(!physics::all_effects().empty());
    for (const auto* effect : physics::all_effects()) {
      QVERIFY2(phrases.contains(QString::fromUtf8(effect->fingerprint.data(), effect->fingerprint.size())),
               std::string(effect->fingerprint).c_str());
    }
  }

  // Each help page is there in Chinese, and what it calls by its name is a text of the Chinese window.
  void helpIsThereInChinese() {
    QString window;
    for (const Message& message : messages_of(chinese_file)) window += message.translations.join(QChar()) + QChar('\n');
    static const QRegularExpression name(QStringLiteral("(?<!\\*)\\*([^*\\n]+)\\*(?!\\*)"));
    const QDir pages(root + QStringLiteral("/docs/help"));
    const QStringList files = pages.entryList({QStringLiteral("*.md")});
    QVERIFY(files.size() > 10);
    for (const QString& file : files) {
      QFile page(pages.filePath(QStringLiteral("zh_CN/") + file));
      QVERIFY2(page.open(QIODevice::ReadOnly), qPrintable(file));
      const QString text = QString::fromUtf8(page.readAll());
      for (auto at = name.globalMatch(text); at.hasNext();) {
        const QString called = at.next().captured(1);
        QVERIFY2(window.contains(called), qPrintable(file + QStringLiteral(": ") + called));
      }
    }
  }

  void coreIsSaidInChinese() {
    const QString english = QStringLiteral("T3_C never moves (always 20.1); it is not used");
    QCOMPARE(coreText(english), english);  // nothing is installed yet
    QTranslator translator;
    QVERIFY(translator.load(QStringLiteral(ZERODRIFT_CHINESE_QM)));
    QCoreApplication::installTranslator(&translator);
    QCOMPARE(coreText(english), QStringLiteral("T3_C 始终不变（始终为 20.1）；未予采用"));
    QCOMPARE(coreText(std::string("ridge on 5 sensors and the inputs")), QStringLiteral("岭回归，5 个传感器及输入量"));
    QCOMPARE(coreText(std::string("/home/user/laser.csv")), QStringLiteral("/home/user/laser.csv"));
    // Every fault of a sensor or camera that a run can name, in the list of what happened and beside the reading.
    static const QRegularExpression latin(QStringLiteral("[a-z]"));
    for (const ErrorCode code :
         {ErrorCode::sensor_dead, ErrorCode::sensor_stuck, ErrorCode::sensor_spiking, ErrorCode::sensor_jumped,
          ErrorCode::sensor_swapped, ErrorCode::camera_frozen, ErrorCode::camera_silent, ErrorCode::camera_unreachable,
          ErrorCode::target_refused, ErrorCode::target_partly_covered, ErrorCode::reference_lost}) {
      const std::string name(name_of(code));
      const QString happened = textOf({name, {}, 2, false});
      QVERIFY2(!happened.contains(latin), qPrintable(happened));
      if (name.starts_with("sensor_")) QVERIFY2(!markOf(code).contains(latin), qPrintable(markOf(code)));
    }
    const ErrorText blocked = textOf({ErrorCode::step_blocked, {{"step", "verify"}, {"needs", "model, upload"}}});
    QCOMPARE(blocked.sentence, QStringLiteral("步骤“验证”尚不能执行：需要模型、上传。"));
    diagnosis::Sentence said;
    said.id = "verdict_missing_effect";
    said.facts = {{"effects", "structure_bending,sensor_lag"}};
    const auto translate = [](const std::string& words) { return coreText(words).toStdString(); };
    QCOMPARE(QString::fromStdString(diagnosis::said(said, translate)),
             QStringLiteral("仿真遗漏了结构件弯曲和传感器响应滞后。"));
    QCoreApplication::removeTranslator(&translator);
    QCOMPARE(coreText(english), english);
  }
};

}  // namespace zerodrift

QTEST_GUILESS_MAIN(zerodrift::LanguageTest)
#include "language_test.moc"
