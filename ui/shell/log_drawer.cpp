#include "ui/shell/log_drawer.h"

#include "ui/widgets/icons.h"

namespace zerodrift::ui {
namespace {

constexpr int longest = 5000;  // entries kept

}  // namespace

LogDrawer::LogDrawer(QWidget* parent) : QFrame(parent) {
  setObjectName("logDrawer");
  m_title = new QLabel(this);
  m_title->setProperty("role", "cardTitle");
  m_copy = new QPushButton(this);
  m_copy->setProperty("role", "link");
  m_close = new QPushButton(this);
  m_close->setProperty("role", "tool");
  m_close->setIcon(lineIcon(Icon::cross));
  m_lines = new QPlainTextEdit(this);
  m_lines->setReadOnly(true);
  m_lines->setFrameShape(QFrame::NoFrame);
  m_lines->setMaximumBlockCount(longest);
  connect(m_copy, &QPushButton::clicked, this, [this] { QGuiApplication::clipboard()->setText(text()); });
  connect(m_close, &QPushButton::clicked, this, &LogDrawer::closeRequested);
  auto* head = new QHBoxLayout;
  head->addWidget(m_title);
  head->addStretch();
  head->addWidget(m_copy);
  head->addWidget(m_close);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(24, 8, 16, 8);
  all->setSpacing(4);
  all->addLayout(head);
  all->addWidget(m_lines);
  setFixedHeight(200);
  retranslate();
}

/// What is told again and again is one line with a count.
void LogDrawer::append(const QDateTime& time, Judgement judgement, const QString& text) {
  if (!m_entries.isEmpty() && m_entries.last().text == text && m_entries.last().judgement == judgement) {
    ++m_entries.last().times;
    m_entries.last().last = time;
    return showEntry(m_entries.last(), true);
  }
  m_entries.append({time, judgement, text, 1, {}});
  if (m_entries.size() > longest) m_entries.removeFirst();
  showEntry(m_entries.last());
}

/// `again`: in place of the last line.
void LogDrawer::showEntry(const Entry& entry, bool again) {
  const char* mark = entry.judgement == Judgement::bad    ? "✕"
                     : entry.judgement == Judgement::warn ? "!"
                     : entry.judgement == Judgement::ok   ? "✓"
                                                          : "·";
  const bool ill = entry.judgement == Judgement::bad || entry.judgement == Judgement::warn;
  QTextCharFormat format;
  format.setForeground(ill ? colors().ink(entry.judgement) : colors().text);
  QString line = entry.time.toLocalTime().toString("HH:mm:ss  ") + QString::fromUtf8(mark) + "  " + entry.text;
  if (entry.times > 1) {
    line += "  " + tr("(%1 times, last %2)").arg(entry.times).arg(entry.last.toLocalTime().toString("HH:mm:ss"));
  }
  // Who reads above must not lose the place; who stands at the end sees what comes.
  QScrollBar* bar = m_lines->verticalScrollBar();
  const bool follows = bar->value() >= bar->maximum();
  const int place = bar->value();
  QTextCursor cursor(m_lines->document());
  cursor.movePosition(QTextCursor::End);
  if (again) {
    cursor.select(QTextCursor::BlockUnderCursor);
    cursor.removeSelectedText();
  }
  if (!m_lines->document()->isEmpty()) cursor.insertBlock();
  cursor.insertText(line, format);
  bar->setValue(follows ? bar->maximum() : place);
}

void LogDrawer::showAll() {
  m_lines->clear();
  for (const Entry& entry : std::as_const(m_entries)) showEntry(entry);
}

QString LogDrawer::text() const {
  return m_lines->toPlainText();
}

void LogDrawer::retranslate() {
  m_title->setText(tr("What happened"));
  m_copy->setText(tr("Copy all"));
  m_close->setToolTip(tr("Close (Ctrl+L)"));
  m_close->setAccessibleName(tr("Close the log"));
  m_lines->setAccessibleName(tr("Log"));
}

void LogDrawer::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  if (event->type() == QEvent::PaletteChange) showAll();
  QFrame::changeEvent(event);
}

}  // namespace zerodrift::ui
