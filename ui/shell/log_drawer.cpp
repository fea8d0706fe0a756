#include "ui/shell/log_drawer.h"

#include "ui/widgets/icons.h"

namespace zerodrift::ui {

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
  m_lines->setMaximumBlockCount(5000);
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

void LogDrawer::append(const QDateTime& time, Judgement judgement, const QString& text) {
  const char* mark = judgement == Judgement::bad    ? "✕"
                     : judgement == Judgement::warn ? "!"
                     : judgement == Judgement::ok   ? "✓"
                                                    : "·";
  QTextCharFormat format;
  if (judgement == Judgement::bad || judgement == Judgement::warn) format.setForeground(colors().ink(judgement));
  QTextCursor cursor(m_lines->document());
  cursor.movePosition(QTextCursor::End);
  if (!m_lines->document()->isEmpty()) cursor.insertBlock();
  cursor.insertText(time.toLocalTime().toString("HH:mm:ss  ") + QString::fromUtf8(mark) + "  " + text, format);
  m_lines->verticalScrollBar()->setValue(m_lines->verticalScrollBar()->maximum());
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
  QFrame::changeEvent(event);
}

}  // namespace zerodrift::ui
