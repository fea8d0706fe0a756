#include "ui/pages/report_page.h"

#include "ui/widgets/card.h"
#include "ui/widgets/paper_sheet.h"
#include "ui/widgets/signature_pad.h"
#include "ui/widgets/toggle_segment.h"

namespace zerodrift::ui {

ReportPage::ReportPage(QWidget* parent) : Page("report", parent) {
  auto* left = new QVBoxLayout;
  left->setSpacing(16);
  left->addWidget(makeSectionCard(), 1);
  left->addWidget(makeHeadCard());
  m_previewCard = new Card(this);
  m_previewCard->setBodyMargins(1, 0, 1, 1);
  m_scroll = new QScrollArea(m_previewCard);
  m_scroll->setObjectName("preview");
  m_scroll->setWidgetResizable(true);
  m_scroll->setFrameShape(QFrame::NoFrame);
  auto* sheets = new QWidget;
  sheets->setProperty("role", "body");
  auto* sheetLayout = new QVBoxLayout(sheets);
  sheetLayout->setContentsMargins(20, 16, 20, 16);
  sheetLayout->setSpacing(14);
  m_noPreview = new QLabel(sheets);
  m_noPreview->setProperty("role", "muted");
  m_noPreview->setAlignment(Qt::AlignCenter);
  sheetLayout->addWidget(m_noPreview);
  m_scroll->setWidget(sheets);
  m_previewCard->body()->addWidget(m_scroll, 1);
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addLayout(left);
  row->addWidget(m_previewCard, 1);
  content()->addLayout(row, 1);
  refresh();
}

Card* ReportPage::makeHeadCard() {
  m_headCard = new Card(this);
  m_headCard->setFixedWidth(360);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(10);
  grid->setVerticalSpacing(4);
  const QStringList names = {"customer", "machine", "serial", "engineer", "standards"};
  for (int i = 0; i < names.size(); ++i) {
    auto* name = new QLabel(m_headCard);
    name->setProperty("role", "muted");
    auto* field = new QLineEdit(m_headCard);
    field->setObjectName("head-" + names[i]);
    name->setBuddy(field);
    grid->addWidget(name, i, 0);
    grid->addWidget(field, i, 1);
    m_fieldNames.append(name);
    m_fields.append(field);
    connect(field, &QLineEdit::editingFinished, this, [this] {
      if (m_filling) return;
      const ReportHead head = {m_fields[0]->text(), m_fields[1]->text(), m_fields[2]->text(), m_fields[3]->text(),
                               m_fields[4]->text()};
      if (head == m_state.head) return;
      m_state.head = head;
      Q_EMIT headEdited(head);
    });
  }
  m_languageName = new QLabel(m_headCard);
  m_languageName->setProperty("role", "muted");
  m_language = new QComboBox(m_headCard);
  m_language->setObjectName("reportLanguage");
  m_languageName->setBuddy(m_language);
  grid->addWidget(m_languageName, static_cast<int>(names.size()), 0);
  grid->addWidget(m_language, static_cast<int>(names.size()), 1);
  connect(m_language, &QComboBox::activated, this, &ReportPage::languageChosen);
  grid->setColumnStretch(1, 1);
  m_company = new QPushButton(m_headCard);
  m_company->setObjectName("company");
  connect(m_company, &QPushButton::clicked, this, &ReportPage::companyRequested);
  m_headCard->tools()->addWidget(m_company);
  m_headCard->body()->addLayout(grid);
  return m_headCard;
}

Card* ReportPage::makeSectionCard() {
  m_sectionCard = new Card(this);
  m_sectionCard->setFixedWidth(360);
  m_view = new ToggleSegment(m_sectionCard);
  m_sectionCard->tools()->addWidget(m_view);
  m_doubtful = new QListWidget(m_sectionCard);
  m_doubtful->setObjectName("doubtful");
  m_doubtful->setWordWrap(true);
  m_doubtful->setIconSize({16, 16});
  m_doubtful->setSpacing(3);
  m_sections = new QListWidget(m_sectionCard);
  m_sections->setObjectName("sections");
  m_signature = new SignaturePad(m_sectionCard);
  auto* content = new QWidget(m_sectionCard);
  auto* contentLayout = new QVBoxLayout(content);
  contentLayout->setContentsMargins(0, 0, 0, 0);
  contentLayout->addWidget(m_sections, 1);
  contentLayout->addWidget(m_signature);
  m_views = new QStackedWidget(m_sectionCard);
  m_views->addWidget(m_doubtful);
  m_views->addWidget(content);
  m_sectionCard->body()->addWidget(m_views, 1);
  connect(m_view, &ToggleSegment::currentChanged, m_views, &QStackedWidget::setCurrentIndex);
  connect(m_signature, &SignaturePad::drawn, this, &ReportPage::signatureDrawn);
  connect(m_sections, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    if (!m_filling) Q_EMIT sectionToggled(item->data(Qt::UserRole).toString(), item->checkState() == Qt::Checked);
  });
  connect(m_doubtful, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
    const QString page = item->data(Qt::UserRole).toString();
    if (!page.isEmpty()) Q_EMIT doubtClicked(page);
  });
  return m_sectionCard;
}

void ReportPage::clearSignature() {
  const QSignalBlocker quiet(m_signature);
  m_signature->clear();
}

void ReportPage::setState(const ReportState& state) {
  m_state = state;
  refresh();
}

QString ReportPage::title() const {
  return tr("Report");
}

QString ReportPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (!m_state.savedTo.isEmpty()) return tr("Saved: %1").arg(m_state.savedTo);
  return tr("Look at the doubtful figures first, fill in the head, then save.");
}

PageAction ReportPage::primary() const {
  return {"primary", tr("Save report"), m_state.blocked.isEmpty(), m_state.blocked,
          tr("Writes the pages at the left into a file of the chosen format")};
}

QVector<PageAction> ReportPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  QVector<PageAction> actions;
  if (!m_state.savedTo.isEmpty()) {
    actions = {{"open", tr("Open"), true, {}, tr("Opens what was saved last")},
               {"folder", tr("Show in folder"), true, {}, tr("Opens the folder of what was saved last")}};
  }
  return actions +
         QVector<PageAction>{
             {"print", tr("Print"), true, {}, tr("The pages at the left, on a printer of this computer")},
             {"bundle",
              tr("Technical bundle"),
              true,
              {},
              tr("For support: job, log, pictures and figures in one zip beside the job, without passwords")}};
}

void ReportPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::file, tr("Nothing to report yet"), m_state.blocked);
    return;
  }
  showContent();
  m_filling = true;
  renderHead();
  renderSections();
  m_filling = false;
  renderPreview();
}

void ReportPage::renderHead() {
  m_headCard->setTitle(tr("Head of the report"));
  m_company->setText(tr("Company"));
  m_company->setToolTip(tr("Logo and address of your company, at the head of every report from this computer"));
  const QStringList names = {tr("Customer"), tr("Machine"), tr("Serial"), tr("Engineer"), tr("Standards")};
  const QStringList values = {m_state.head.customer, m_state.head.machine, m_state.head.serial, m_state.head.engineer,
                              m_state.head.standards};
  for (int i = 0; i < names.size(); ++i) {
    m_fieldNames[i]->setText(names[i]);
    if (!m_fields[i]->hasFocus()) m_fields[i]->setText(values[i]);
  }
  m_fields[4]->setPlaceholderText(tr("those that were followed, if any"));
  m_fields[4]->setToolTip(tr("For example ISO 230-3:2020. Only what was run by the standard may be named here."));
}

void ReportPage::renderSections() {
  m_sectionCard->setTitle(tr("Content"));
  m_view->setItems(
      {m_state.doubtful.isEmpty() ? tr("Doubtful") : tr("Doubtful (%1)").arg(m_state.doubtful.size()), tr("Sections")});
  renderDoubtful();
  m_sections->clear();
  for (const ReportSection& section : m_state.sections) {
    auto* item = new QListWidgetItem(
        section.note.isEmpty() ? section.title : section.title + QStringLiteral("  –  ") + section.note, m_sections);
    item->setFlags(section.always ? Qt::ItemIsSelectable
                                  : Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(section.included ? Qt::Checked : Qt::Unchecked);
    item->setData(Qt::UserRole, section.id);
    item->setSizeHint({100, 28});
  }
  m_languageName->setText(tr("Language"));
  m_language->clear();
  m_language->addItems(m_state.languages);
  m_language->setCurrentIndex(m_state.language);
  m_language->setAccessibleName(tr("Language of the report"));
  m_language->setToolTip(m_language->accessibleName());
}

/// By what they are about, what is worst first: one cause often shows in many figures.
void ReportPage::renderDoubtful() {
  m_doubtful->clear();
  QStringList groups;
  for (const DoubtfulFigure& figure : m_state.doubtful) {
    if (!groups.contains(figure.group)) groups.append(figure.group);
  }
  for (const QString& group : std::as_const(groups)) {
    const auto in_group = [&group](const DoubtfulFigure& figure) { return figure.group == group; };
    if (!group.isEmpty()) {
      const auto count = std::count_if(m_state.doubtful.begin(), m_state.doubtful.end(), in_group);
      auto* heading = new QListWidgetItem(tr("%1 (%2)").arg(group).arg(count), m_doubtful);
      heading->setFlags(Qt::ItemIsEnabled);
      QFont bold = heading->font();
      bold.setWeight(QFont::DemiBold);
      heading->setFont(bold);
    }
    for (const DoubtfulFigure& figure : m_state.doubtful) {
      if (!in_group(figure)) continue;
      auto* item = new QListWidgetItem(figure.text, m_doubtful);
      QPixmap shape(32, 32);
      shape.fill(Qt::transparent);
      QPainter painter(&shape);
      drawJudgement(painter, QRectF(3, 3, 26, 26), figure.judgement);
      painter.end();
      item->setIcon(QIcon(shape));
      item->setData(Qt::UserRole, figure.pageId);
      item->setToolTip(tr("Click to look into it"));
    }
  }
  if (!m_state.doubtful.isEmpty()) return;
  auto* item = new QListWidgetItem(tr("No figure of this job looks doubtful."), m_doubtful);
  item->setFlags(Qt::ItemIsEnabled);
}

void ReportPage::renderPreview() {
  m_previewCard->setTitle(tr("Preview"));
  m_previewCard->setSubtitle(m_state.pages.size() == 1 ? tr("1 page") : tr("%1 pages").arg(m_state.pages.size()));
  m_noPreview->setText(tr("The preview is being made."));
  m_noPreview->setVisible(m_state.pages.isEmpty());
  auto* layout = m_scroll->widget()->layout();
  while (m_sheets.size() > m_state.pages.size()) delete m_sheets.takeLast();
  while (m_sheets.size() < m_state.pages.size()) {
    auto* sheet = new PaperSheet(m_scroll->widget());
    layout->addWidget(sheet);
    m_sheets.append(sheet);
  }
  const int width = std::clamp(m_scroll->viewport()->width() - 56, 200, 760);
  for (int i = 0; i < m_sheets.size(); ++i) {
    m_sheets[i]->setPicture(m_state.pages[i], width);
    m_sheets[i]->setAccessibleName(tr("Page %1").arg(i + 1));
  }
}

void ReportPage::resizeEvent(QResizeEvent* event) {
  Page::resizeEvent(event);
  if (!m_state.pages.isEmpty()) renderPreview();
}

}  // namespace zerodrift::ui
