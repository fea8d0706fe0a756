#include "ui/pages/machine_start.h"

#include "ui/widgets/card.h"
#include "ui/widgets/colors.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int sample = 3;  // among the buttons

/// A job in the list: its name, below it how far it is.
class TwoLines : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Colors& c = colors();
    painter->save();
    painter->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    const bool over = option.state & (QStyle::State_MouseOver | QStyle::State_Selected);
    if (over) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(c.soft(c.accent));
      painter->drawRoundedRect(option.rect, 4, 4);
    }
    drawIcon(*painter, QRectF(option.rect.x() + 8, option.rect.center().y() - 11, 22, 22), Icon::file, c.muted);
    const QRect inside = option.rect.adjusted(42, 4, -8, -4);
    const QString text = index.data().toString();
    painter->setFont(uiFont(13, QFont::DemiBold));
    painter->setPen(c.text);
    painter->drawText(inside, Qt::AlignTop, text.section('\n', 0, 0));
    painter->setFont(uiFont(12));
    painter->setPen(c.muted);
    painter->drawText(inside, Qt::AlignBottom, text.section('\n', 1));
    painter->restore();
  }
};

}  // namespace

MachineStart::MachineStart(QWidget* parent) : QWidget(parent) {
  m_startCard = new Card(this);
  const QVector<Icon> icons = {Icon::plus, Icon::file, Icon::folder, Icon::chart, Icon::machine};
  for (int i = 0; i < icons.size(); ++i) {
    auto* button = new QPushButton(lineIcon(icons[i]), {}, m_startCard);
    button->setObjectName(QStringList({"startNew", "startOwn", "startOpen", "startSample", "startVirtual"})[i]);
    button->setProperty("big", true);
    button->setIconSize({20, 20});
    button->setStyleSheet("text-align: left");
    auto* note = new WrapLabel(m_startCard);
    note->setProperty("role", "muted");
    m_startCard->body()->addWidget(button);
    m_startCard->body()->addWidget(note);
    m_startCard->body()->addSpacing(8);
    m_startButtons.append(button);
    m_startNotes.append(note);
  }
  m_startCard->body()->addStretch();
  connect(m_startButtons[0], &QPushButton::clicked, this, &MachineStart::newJobRequested);
  connect(m_startButtons[1], &QPushButton::clicked, this, &MachineStart::ownRecordingRequested);
  connect(m_startButtons[2], &QPushButton::clicked, this, [this] { Q_EMIT openJobRequested({}); });
  connect(m_startButtons[sample], &QPushButton::clicked, this, &MachineStart::sampleRequested);
  connect(m_startButtons[4], &QPushButton::clicked, this, &MachineStart::virtualMachineRequested);

  m_recentCard = new Card(this);
  m_recent = new QListWidget(m_recentCard);
  m_recent->setObjectName("recentJobs");
  m_recent->setSpacing(1);
  m_noRecent = new WrapLabel(m_recentCard);
  m_noRecent->setProperty("role", "muted");
  m_recentCard->body()->addWidget(m_noRecent);
  m_recentCard->body()->addWidget(m_recent, 1);
  m_recentCard->body()->addStretch();
  connect(m_recent, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { Q_EMIT openJobRequested(item->data(Qt::UserRole).toString()); });
  connect(m_recent, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { Q_EMIT openJobRequested(item->data(Qt::UserRole).toString()); });

  m_recent->setItemDelegate(new TwoLines(m_recent));

  m_wayCard = new Card(this);
  for (int i = 0; i < 9; ++i) {
    auto* line = new QLabel(m_wayCard);
    line->setTextFormat(Qt::RichText);
    m_wayCard->body()->addWidget(line);
    m_way.append(line);
  }
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(m_recentCard, 1);
  right->addWidget(m_wayCard);
  auto* all = new QHBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addWidget(m_startCard, 2);
  all->addLayout(right, 3);
}

void MachineStart::setState(const QVector<RecentJob>& recent, bool sampleAvailable) {
  m_startCard->setTitle(tr("Start"));
  m_recentCard->setTitle(tr("Recent jobs"));
  const QStringList names = {tr("New job"), tr("Use my own recording"), tr("Open job"), tr("Open the sample job"),
                             tr("Connect to the virtual machine")};
  const QStringList notes = {
      tr("One file holds the whole commissioning: measurements, model, tables, report."),
      tr("A logger's table of temperatures and errors, from any machine. Nothing needs to be connected."),
      tr("Go on where the job stopped; also after a crash."),
      tr("A finished commissioning to look around in. Nothing needs to be connected."),
      tr("A five-axis machine in software, with controller and cameras, to try everything without risk."),
  };
  for (int i = 0; i < names.size(); ++i) {
    m_startButtons[i]->setText(names[i]);
    m_startNotes[i]->setText(notes[i]);
  }
  m_startButtons[sample]->setVisible(sampleAvailable);
  m_startNotes[sample]->setVisible(sampleAvailable);
  m_wayCard->setTitle(tr("The way through"));
  const QStringList way = {
      tr("Machine") + '|' + tr("connect, see that all sensors live and the machine is cold"),
      tr("Calibrate") + '|' + tr("teach the camera what a micrometre is"),
      tr("Warm-up") + '|' + tr("record temperatures and errors while the machine warms"),
      tr("Sensors") + '|' + tr("keep the few that carry the error"),
      tr("Fit") + '|' + tr("make the model and judge it on what it has not seen"),
      tr("Physics") + '|' + tr("find what the simulation lacks"),
      tr("Upload") + '|' + tr("write the table as one transaction, old one saved"),
      tr("Verify") + '|' + tr("prove on the machine that the error is gone"),
      tr("Report") + '|' + tr("hand it over, every figure traceable"),
  };
  for (int i = 0; i < way.size(); ++i) {
    m_way[i]->setText(QStringLiteral("<b>%1&nbsp; %2</b> &nbsp;<span style='color:%3'>%4</span>")
                          .arg(i + 1)
                          .arg(way[i].section('|', 0, 0), colors().muted.name(), way[i].section('|', 1)));
  }
  m_noRecent->setText(tr("No jobs yet. Jobs that you make or open are listed here."));
  m_noRecent->setVisible(recent.isEmpty());
  m_recent->setVisible(!recent.isEmpty());
  m_recent->clear();
  for (const RecentJob& job : recent) {
    auto* item = new QListWidgetItem(job.name + '\n' + job.detail, m_recent);
    item->setData(Qt::UserRole, job.path);
    item->setToolTip(job.path);
    item->setSizeHint({100, 46});
  }
}

}  // namespace zerodrift::ui
