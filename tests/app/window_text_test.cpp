// The window in both languages at its smallest: no text is cut, none stays behind in the language before.

#include <QApplication>
#include <QTest>
#include <QTranslator>

#include "tests/ui/gallery/samples.h"
#include "ui/pages/page.h"
#include "ui/plots/custom_plot.h"
#include "ui/shell/main_window.h"
#include "ui/shell/rail.h"
#include "ui/shell/theme.h"
#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {
namespace {

constexpr int slack_px = 1;  // of rounding

QString nameOf(const QWidget* widget) {
  QString name = QString::fromLatin1(widget->metaObject()->className()).section("::", -1);
  if (!widget->objectName().isEmpty()) name += '#' + widget->objectName();
  return name;
}

/// What of this label, button or list cannot be read; empty when all can.
QString cutIn(const QWidget* widget) {
  if (widget->property("elides").toBool() || qobject_cast<const StepButton*>(widget) != nullptr) return {};
  const auto said = [&](const QString& text) { return nameOf(widget) + ": \"" + text + '"'; };
  if (const auto* label = qobject_cast<const QLabel*>(widget)) {
    if (label->text().isEmpty()) return {};
    const bool cut = label->wordWrap() ? label->heightForWidth(label->width()) > label->height() + slack_px
                                       : label->sizeHint().width() > label->width() + slack_px;
    return cut ? said(label->text()) : QString();
  }
  if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) {
    return !button->text().isEmpty() && button->sizeHint().width() > button->width() + slack_px ? said(button->text())
                                                                                                : QString();
  }
  if (const auto* combo = qobject_cast<const QComboBox*>(widget)) {
    constexpr int arrow_px = 30;
    const int room = combo->width() - arrow_px;
    const QString text = combo->currentIndex() < 0 ? combo->placeholderText() : combo->currentText();
    return combo->fontMetrics().horizontalAdvance(text) > room ? said(text) : QString();
  }
  if (const auto* header = qobject_cast<const QHeaderView*>(widget)) {
    if (header->orientation() != Qt::Horizontal) return {};
    for (int i = 0; i < header->count(); ++i) {
      const QString text = header->model()->headerData(i, Qt::Horizontal).toString();
      constexpr int padding_px = 8;
      if (header->fontMetrics().horizontalAdvance(text) + padding_px > header->sectionSize(i)) return said(text);
    }
  }
  return {};
}

/// Whether a widget reaches beyond the card or page that holds it.
bool sticksOut(const QWidget* widget) {
  const QWidget* parent = widget->parentWidget();
  if (parent == nullptr || !parent->property("card").toBool()) return false;
  return widget->geometry().right() > parent->width() + slack_px ||
         widget->geometry().bottom() > parent->height() + slack_px;
}

/// Axes, limits, marks, spans and what stands in an empty plot.
QStringList wordsIn(const QCustomPlot& plot) {
  QStringList words;
  for (const QCPAxis* axis : plot.axisRect()->axes()) {
    if (!axis->visible()) continue;
    words << axis->label();
    if (const auto named = axis->ticker().dynamicCast<QCPAxisTickerText>()) words << named->ticks().values();
  }
  for (int i = 0; i < plot.itemCount(); ++i) {
    const auto* text = qobject_cast<const QCPItemText*>(plot.item(i));
    // Those that find no room are hidden: where they find it they must read right.
    if (text != nullptr) words << text->text();
  }
  return words;
}

QStringList textsOf(const QWidget* widget) {
  QStringList texts = {widget->toolTip(), widget->accessibleName(), widget->accessibleDescription()};
  if (const auto* label = qobject_cast<const QLabel*>(widget)) texts << label->text();
  if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) texts << button->text();
  if (const auto* line = qobject_cast<const QLineEdit*>(widget)) texts << line->placeholderText();
  if (const auto* edit = qobject_cast<const QTextEdit*>(widget)) texts << edit->toPlainText();
  if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(widget)) texts << spin->text();
  if (const auto* combo = qobject_cast<const QComboBox*>(widget)) {
    for (int i = 0; i < combo->count(); ++i) texts << combo->itemText(i);
  }
  if (const auto* view = qobject_cast<const QTableView*>(widget); view != nullptr && view->model() != nullptr) {
    const auto* model = view->model();
    for (int c = 0; c < model->columnCount(); ++c) {
      texts << model->headerData(c, Qt::Horizontal).toString()
            << model->headerData(c, Qt::Horizontal, Qt::ToolTipRole).toString();
      for (int r = 0; r < model->rowCount(); ++r) {
        texts << model->index(r, c).data().toString() << model->index(r, c).data(Qt::ToolTipRole).toString();
      }
    }
  }
  if (const auto* plot = qobject_cast<const QCustomPlot*>(widget)) texts << wordsIn(*plot);
  texts.removeAll(QString());
  return texts;
}

}  // namespace

class WindowTextTest : public QObject {
  Q_OBJECT

 private:
  QTranslator m_chinese;

  static QStringList cutIn(MainWindow& window, const samples::Scene& scene) {
    QStringList cut;
    const QString where = scene.page + '/' + scene.name + ": ";
    listenToCuts([&](const QString& text, bool readable) {
      if (!readable) cut << where + "painted \"" + text + '"';
    });
    const QPixmap drawn = window.grab();
    listenToCuts({});
    if (drawn.size() != QSize(1280, 720)) cut << where + "the window is not of the smallest size";
    for (const QWidget* widget : window.findChildren<QWidget*>()) {
      if (!widget->isVisible()) continue;
      if (const QString text = ui::cutIn(widget); !text.isEmpty()) cut << where + text;
      if (sticksOut(widget)) cut << where + nameOf(widget) + " reaches out of its card";
    }
    // A banner, a list of troubles or the log takes its room for a while: then the page may scroll.
    const bool crowded = QStringList({"banner", "trouble", "log"}).contains(scene.name);
    for (const QWidget* up = window.currentPage(); up != nullptr; up = up->parentWidget()) {
      const auto* scroll = qobject_cast<const QScrollArea*>(up);
      if (scroll == nullptr) continue;
      if (scroll->horizontalScrollBar()->maximum() > 0) cut << where + "the page is wider than the window";
      if (!crowded && scroll->verticalScrollBar()->maximum() > 0) cut << where + "the page is higher than the window";
      break;
    }
    return cut;
  }

  void speak(bool chinese) {
    QApplication::removeTranslator(&m_chinese);
    QLocale::setDefault(chinese ? QLocale("zh_CN") : QLocale("en_US"));
    if (chinese) QApplication::installTranslator(&m_chinese);
    QCoreApplication::sendPostedEvents();
    QCoreApplication::processEvents();
  }

 private Q_SLOTS:
  void initTestCase() {
    new Theme(*qApp);  // the application's own
    QVERIFY(m_chinese.load(QStringLiteral(":/i18n/zerodrift_zh_CN.qm")));
    QVERIFY2(QFontDatabase::writingSystems("Noto Sans CJK SC").contains(QFontDatabase::SimplifiedChinese),
             "The tests need the package fonts-noto-cjk.");
  }

  void nothingIsCut_data() {
    QTest::addColumn<bool>("chinese");
    QTest::newRow("English") << false;
    QTest::newRow("Chinese") << true;
  }

  void nothingIsCut() {
    QFETCH(bool, chinese);
    speak(chinese);
    MainWindow window;
    samples::fillWindow(window);
    window.setLanguageName(chinese ? QStringLiteral("中文") : QStringLiteral("EN"));
    window.resize(1280, 720);
    window.show();
    QStringList cut;
    for (const auto& scene : samples::scenes()) {
      samples::play(window, scene);
      QTest::qWait(30);
      // Layouts settle over a few rounds of events.
      QStringList here;
      for (int round = 0; round < 8; ++round) {
        here = cutIn(window, scene);
        if (here.isEmpty()) break;
        QTest::qWait(60);
      }
      cut += here;
    }
    cut.removeDuplicates();
    QVERIFY2(cut.isEmpty(), qPrintable(QChar('\n') + cut.join(QChar('\n'))));
  }

  // A window that changes its language reads like one that was made in it.
  void switchingLeavesNoTextBehind() {
    QStringList behind;
    for (const auto& scene : samples::scenes()) {
      if (scene.name == "log" || scene.name == "banner") continue;  // what happened then was said then
      const auto texts = [&scene](MainWindow& window) {
        QVector<QPair<QString, QStringList>> all;
        for (const QWidget* widget : window.currentPage()->findChildren<QWidget*>()) {
          // What is hidden is said when it is shown.
          if (!widget->isVisible()) continue;
          if (const QStringList said = textsOf(widget); !said.isEmpty()) all.append({nameOf(widget), said});
        }
        for (const QWidget* widget : window.rail()->findChildren<QWidget*>())
          all.append({nameOf(widget), textsOf(widget)});
        all.append({"primary", {window.primaryButton()->text(), window.primaryButton()->toolTip()}});
        return all;
      };
      const auto made = [&scene](MainWindow& window) {
        samples::fillWindow(window);
        window.setLanguageName("x");
        window.show();
        samples::play(window, scene);
        QCoreApplication::processEvents();
      };
      speak(false);
      MainWindow switched;
      made(switched);
      speak(true);
      const auto after = texts(switched);
      MainWindow fresh;
      made(fresh);
      const auto wanted = texts(fresh);
      QCOMPARE(after.size(), wanted.size());
      for (qsizetype i = 0; i < after.size(); ++i) {
        if (after[i] == wanted[i]) continue;
        behind << scene.page + '/' + scene.name + ' ' + after[i].first + ": " + after[i].second.join(" | ") +
                      "\n      wanted: " + wanted[i].second.join(" | ");
      }
    }
    speak(false);
    QVERIFY2(behind.isEmpty(), qPrintable(QChar('\n') + behind.join(QChar('\n'))));
  }
};

}  // namespace zerodrift::ui

QTEST_MAIN(zerodrift::ui::WindowTextTest)
#include "window_text_test.moc"
