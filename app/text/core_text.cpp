#include "app/text/core_text.h"

#include <QCoreApplication>
#include <QHash>
#include <QMutex>
#include <QRegularExpression>
#include <algorithm>

#include "app/text/core_phrases.h"
#include "app/text/error_text.h"
#include "core/base/error_json.h"

namespace zerodrift {
namespace {

constexpr int deepest = 4;  // phrases stand inside phrases
constexpr qsizetype texts_remembered = 4000;
const QString part_mark = QStringLiteral("; ");

struct Phrase {
  const char* english;
  QRegularExpression shape;
  QVector<int> gaps;  // which gap the captures fill, in the order of the English
  qsizetype weight = 0;
};

Phrase phrase_of(const char* english) {
  static const QRegularExpression gap(QStringLiteral("%(\\d)"));
  const QString text = QString::fromUtf8(english);
  Phrase phrase{english, {}, {}, text.size()};
  QString shape;
  qsizetype from = 0;
  for (auto at = gap.globalMatch(text); at.hasNext();) {
    const auto found = at.next();
    shape += QRegularExpression::escape(text.mid(from, found.capturedStart() - from)) + QStringLiteral("(.*?)");
    phrase.gaps.append(found.captured(1).toInt());
    phrase.weight -= found.capturedLength();
    from = found.capturedEnd();
  }
  shape += QRegularExpression::escape(text.mid(from));
  phrase.shape.setPattern(QRegularExpression::anchoredPattern(shape));
  phrase.shape.setPatternOptions(QRegularExpression::DotMatchesEverythingOption);
  return phrase;
}

/// Looks texts up in the phrases of core; knows when the language has changed.
class Phrasebook {
 public:
  Phrasebook() {
    for (const char* english : corePhrases()) {
      Phrase phrase = phrase_of(english);
      if (phrase.gaps.isEmpty()) {
        m_whole.insert(QString::fromUtf8(english), english);
      } else {
        m_open.append(std::move(phrase));
      }
    }
    // What says more fits closer.
    std::stable_sort(m_open.begin(), m_open.end(),
                     [](const Phrase& a, const Phrase& b) { return a.weight > b.weight; });
  }

  QString say(const QString& english) {
    const QMutexLocker lock(&m_mutex);
    const QString language = translated("language of core's texts");
    if (language != m_language || m_said.size() > texts_remembered) m_said.clear();
    m_language = language;
    if (language == QStringLiteral("language of core's texts")) return english;
    const auto known = m_said.constFind(english);
    if (known != m_said.constEnd()) return *known;
    return *m_said.insert(english, lookUp(english, deepest));
  }

 private:
  static QString translated(const char* english) { return QCoreApplication::translate("core", english); }

  QString lookUp(const QString& english, int depth) const {
    if (const auto whole = m_whole.constFind(english); whole != m_whole.constEnd()) return translated(*whole);
    if (depth == 0) return english;
    for (const Phrase& phrase : m_open) {
      const auto fit = phrase.shape.match(english);
      if (!fit.hasMatch()) continue;
      QStringList figures = fit.capturedTexts().mid(1);
      // A gap holds no further part of a list: that is for the split below.
      if (figures.join(QChar()).contains(part_mark)) continue;
      QString text = translated(phrase.english);
      for (QString& figure : figures) figure = lookUp(figure, depth - 1);
      return filled(text, phrase.gaps, figures);
    }
    if (english.contains(part_mark)) {
      QStringList parts = english.split(part_mark);
      for (QString& part : parts) part = lookUp(part, depth - 1);
      return parts.join(translated("; "));
    }
    return english;
  }

  static QString filled(const QString& text, const QVector<int>& gaps, const QStringList& figures) {
    static const QRegularExpression gap(QStringLiteral("%(\\d)"));
    QString out;
    qsizetype from = 0;
    for (auto at = gap.globalMatch(text); at.hasNext();) {
      const auto found = at.next();
      out += text.mid(from, found.capturedStart() - from) + figures.value(gaps.indexOf(found.captured(1).toInt()));
      from = found.capturedEnd();
    }
    return out + text.mid(from);
  }

  QMutex m_mutex;
  QString m_language;
  QHash<QString, const char*> m_whole;
  QVector<Phrase> m_open;
  QHash<QString, QString> m_said;
};

/// Core tells of a failure inside another text by its code and facts, at the end: "...: machine_silent what=reading".
QString withErrorInWords(const QString& text) {
  if (!text.contains(QLatin1Char('='))) return text;
  for (qsizetype from = 0; from >= 0;) {
    if (const auto error = error_described(text.mid(from).toStdString())) {
      QString sentence = textOf(*error).sentence;
      while (sentence.endsWith(QLatin1Char('.')) || sentence.endsWith(QChar(0x3002))) sentence.chop(1);
      return text.left(from) + sentence;
    }
    const qsizetype colon = text.indexOf(QStringLiteral(": "), from);
    from = colon < 0 ? -1 : colon + 2;
  }
  return text;
}

}  // namespace

QString coreText(const QString& english) {
  static Phrasebook book;
  return english.isEmpty() ? english : book.say(withErrorInWords(english));
}

QString coreText(const std::string& english) {
  return coreText(QString::fromStdString(english));
}

std::vector<const char*> corePhrases() {
  std::vector<const char*> all;
  for (const auto& group : {phrases_of_measuring(), phrases_of_models(), phrases_of_diagnosis(), phrases_of_machines(),
                            phrases_of_devices(), phrases_of_files(), phrases_of_tables(), phrases_of_the_system()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace zerodrift
