#include "ui/shell/help_panel.h"

#include "ui/widgets/icons.h"

namespace zerodrift::ui {

HelpPanel::HelpPanel(QWidget* parent) : QFrame(parent) {
  setObjectName("helpPanel");
  m_title = new QLabel(this);
  m_title->setProperty("role", "cardTitle");
  m_close = new QPushButton(this);
  m_close->setProperty("role", "tool");
  m_close->setIcon(lineIcon(Icon::cross));
  m_text = new QTextBrowser(this);
  m_text->setFrameShape(QFrame::NoFrame);
  m_text->setOpenExternalLinks(false);
  m_text->setOpenLinks(false);
  connect(m_close, &QPushButton::clicked, this, &HelpPanel::closeRequested);
  auto* head = new QHBoxLayout;
  head->addWidget(m_title);
  head->addStretch();
  head->addWidget(m_close);
  m_keys = new QPushButton(this);
  m_keys->setObjectName("helpKeys");
  m_about = new QPushButton(this);
  m_about->setObjectName("helpAbout");
  connect(m_keys, &QPushButton::clicked, this, [this] { Q_EMIT pageWanted("keys"); });
  connect(m_about, &QPushButton::clicked, this, [this] { Q_EMIT pageWanted("about"); });
  auto* foot = new QHBoxLayout;
  foot->addWidget(m_keys);
  foot->addWidget(m_about);
  foot->addStretch();
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 10, 8, 12);
  all->setSpacing(4);
  all->addLayout(head);
  all->addWidget(m_text, 1);
  all->addLayout(foot);
  retranslate();
}

bool HelpPanel::open(const QString& pageId) {
  m_pageId = pageId;
  retranslate();
  load();
  return !text().isEmpty();
}

QString HelpPanel::text() const {
  return m_text->toPlainText();
}

void HelpPanel::load() {
  QFile file(QStringLiteral(":/help/%1/%2.md").arg(QLocale().name(), m_pageId));
  if (!file.exists()) file.setFileName(QStringLiteral(":/help/%1.md").arg(m_pageId));
  m_text->clear();
  m_text->document()->setDefaultFont(uiFont(13));
  if (!file.open(QIODevice::ReadOnly)) return;
  m_text->setMarkdown(QString::fromUtf8(file.readAll()));
  m_text->document()->setIndentWidth(18);
  // Markdown comes without room between its paragraphs.
  for (QTextBlock block = m_text->document()->begin(); block.isValid(); block = block.next()) {
    QTextCursor cursor(block);
    QTextBlockFormat format = block.blockFormat();
    format.setTopMargin(format.headingLevel() > 1 ? 10 : 0);
    format.setBottomMargin(block.textList() != nullptr ? 4 : 8);
    format.setLineHeight(118, QTextBlockFormat::ProportionalHeight);
    cursor.setBlockFormat(format);
    if (format.headingLevel() == 0) continue;
    QTextCharFormat letters;
    letters.setFont(uiFont(format.headingLevel() == 1 ? 18 : 14, QFont::DemiBold));
    cursor.select(QTextCursor::BlockUnderCursor);
    cursor.mergeCharFormat(letters);
  }
  m_text->moveCursor(QTextCursor::Start);
}

void HelpPanel::retranslate() {
  m_title->setText(m_pageId == "about"  ? QStringLiteral("Zerodrift " ZERODRIFT_VERSION)
                   : m_pageId == "keys" ? tr("Keys")
                                        : tr("Help for this step"));
  m_keys->setText(tr("Keys"));
  m_about->setText(tr("About, licences"));
  m_close->setToolTip(tr("Close (F1)"));
  m_close->setAccessibleName(tr("Close the help"));
  m_text->setAccessibleName(m_title->text());
}

void HelpPanel::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    retranslate();
    load();
  }
  if (event->type() == QEvent::PaletteChange) {
    m_close->setIcon(lineIcon(Icon::cross));
    load();  // markdown takes its colours while it is read
  }
  QFrame::changeEvent(event);
}

void HelpPanel::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return Q_EMIT closeRequested();
  QFrame::keyPressEvent(event);
}

}  // namespace zerodrift::ui
