#include "ui/pages/rig_setup.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QShortcut>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "ui/widgets/camera_view.h"
#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/histogram.h"
#include "ui/widgets/problem_banner.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int found_height = 112;
constexpr int camera_height = 210;

const QStringList& searchNames() {
  static const QStringList names = {"ports", "units", "network", "cameras"};
  return names;
}

}  // namespace

RigSetup::RigSetup(QWidget* parent) : QWidget(parent) {
  setObjectName("rigSetup");
  m_card = new Card(this);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(m_card);
  makeHead(m_card->body());
  m_views = new QStackedWidget(m_card);
  m_views->addWidget(makeForm());
  m_views->addWidget(makeSignals());
  m_card->body()->addWidget(m_views, 1);
  connect(m_view, &ToggleSegment::currentChanged, m_views, &QStackedWidget::setCurrentIndex);
  connect(new QShortcut(QKeySequence::Redo, this), &QShortcut::activated, this, &RigSetup::redoRequested);
  retranslate();
}

QPushButton* RigSetup::button(const char* name, QBoxLayout* into) {
  auto* made = new QPushButton(m_card);
  made->setObjectName(QString::fromLatin1(name));
  into->addWidget(made);
  return made;
}

void RigSetup::makeHead(QVBoxLayout* into) {
  m_view = new ToggleSegment(m_card);
  m_file = new QLabel(m_card);
  m_file->setObjectName("rigFile");
  m_file->setProperty("role", "caption");
  m_card->tools()->addWidget(m_file);
  m_card->tools()->addWidget(m_view);
  m_undo = button("rigUndo", m_card->tools());
  m_redo = button("rigRedo", m_card->tools());
  m_problem = new ProblemBanner(m_card);
  into->addWidget(m_problem);
  connect(m_undo, &QPushButton::clicked, this, &RigSetup::undoRequested);
  connect(m_redo, &QPushButton::clicked, this, &RigSetup::redoRequested);
}

QWidget* RigSetup::makeForm() {
  m_form = new ItemForm(m_card);
  m_form->setUndoShown(false);
  makeTools(m_form->right());
  connect(m_form, &ItemForm::selected, this, &RigSetup::selected);
  connect(m_form, &ItemForm::edited, this, &RigSetup::edited);
  connect(m_form, &ItemForm::addRequested, this, &RigSetup::addRequested);
  connect(m_form, &ItemForm::removeRequested, this, &RigSetup::removeRequested);
  return m_form;
}

void RigSetup::makeTools(QVBoxLayout* into) {
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  for (const QString& name : searchNames()) {
    m_search.append(button(("find:" + name.toLatin1()).constData(), row));
    connect(m_search.last(), &QPushButton::clicked, this, [this, name] { Q_EMIT findRequested(name); });
  }
  m_test = button("rigTest", row);
  m_addSensors = button("addSensors", row);
  m_preview = button("rigPreview", row);
  m_preview->setCheckable(true);
  row->addStretch();
  into->addLayout(row);
  m_progress = new ProgressStrip(m_card);
  m_found = new DataTable(m_card);
  m_found->setObjectName("found");
  m_found->setFixedHeight(found_height);
  m_result = new WrapLabel(m_card);
  m_result->setObjectName("rigResult");
  into->addWidget(m_progress);
  into->addWidget(m_result);
  into->addWidget(m_found);
  m_cameraBox = new QWidget(m_card);
  m_camera = new CameraView(m_cameraBox);
  m_camera->setDrawing(CameraView::Drawing::target);
  m_histogram = new Histogram(m_cameraBox);
  m_cameraNote = new WrapLabel(m_cameraBox);
  m_cameraNote->setProperty("role", "caption");
  m_cameraNote->setObjectName("cameraNote");
  auto* beside = new QVBoxLayout;
  beside->addWidget(m_histogram);
  beside->addWidget(m_cameraNote);
  beside->addStretch();
  auto* box = new QHBoxLayout(m_cameraBox);
  box->setContentsMargins(0, 0, 0, 0);
  box->setSpacing(12);
  box->addWidget(m_camera, 3);
  box->addLayout(beside, 2);
  m_cameraBox->setFixedHeight(camera_height);
  into->addWidget(m_cameraBox);
  connect(m_test, &QPushButton::clicked, this, &RigSetup::testRequested);
  connect(m_addSensors, &QPushButton::clicked, this, &RigSetup::sensorsOfDeviceRequested);
  connect(m_preview, &QPushButton::clicked, this, &RigSetup::previewToggled);
  connect(m_progress, &ProgressStrip::cancelRequested, this, &RigSetup::cancelRequested);
  connect(m_found, &DataTable::rowActivated, this, &RigSetup::foundChosen);
  connect(m_found, &DataTable::rowSelected, this, &RigSetup::foundChosen);
  connect(m_camera, &CameraView::regionDrawn, this, &RigSetup::regionDrawn);
}

QWidget* RigSetup::makeSignals() {
  auto* view = new QWidget(m_card);
  m_signals = new SignalTable(view);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  m_addSensor = button("addSensor", row);
  m_removeSensor = button("removeSensor", row);
  m_live = button("rigLive", row);
  m_live->setCheckable(true);
  m_signalNote = new WrapLabel(view);
  m_signalNote->setProperty("role", "caption");
  row->addWidget(m_signalNote, 1);
  auto* all = new QVBoxLayout(view);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(8);
  all->addWidget(m_signals, 1);
  all->addLayout(row);
  connect(m_signals, &SignalTable::edited, this, &RigSetup::signalEdited);
  connect(m_signals, &SignalTable::rowSelected, this, [this] { renderSignals(); });
  connect(m_addSensor, &QPushButton::clicked, this, &RigSetup::sensorAdded);
  connect(m_removeSensor, &QPushButton::clicked, this, [this] { Q_EMIT sensorRemoved(m_signals->currentRow()); });
  connect(m_live, &QPushButton::clicked, this, &RigSetup::liveToggled);
  return view;
}

void RigSetup::setState(const RigSetupState& state) {
  m_state = state;
  render();
}

void RigSetup::setLines(const QVector<SignalLine>& lines) {
  m_state.lines = lines;
  renderSignals();
}

void RigSetup::setProgress(const QString& busy, double fraction) {
  if (!busy.isEmpty()) m_progress->setProgress(busy, fraction);
}

void RigSetup::setPicture(const QImage& picture, const QRectF& target, const QVector<int>& counts,
                          const QString& note) {
  CameraMarks marks;
  marks.targetRegion = target;
  m_camera->setImage(picture);
  m_camera->setMarks(marks);
  m_histogram->setCounts(counts);
  m_cameraNote->setText(note);
}

void RigSetup::showView(int index) {
  m_view->setCurrentIndex(index);
}

void RigSetup::render() {
  if (m_state.sentence.isEmpty()) {
    m_problem->clear();
  } else {
    m_problem->setProblem({ProblemKind::warning, m_state.sentence, m_state.remedy, {}});
  }
  const QString file = m_state.file.isEmpty() ? tr("not saved yet") : m_state.file.section(QLatin1Char('/'), -1);
  m_file->setText(m_state.changed && !m_state.file.isEmpty() ? tr("%1, changed").arg(file) : file);
  m_file->setToolTip(m_state.file);
  m_undo->setEnabled(m_state.form.canUndo);
  m_redo->setEnabled(m_state.canRedo);
  m_form->setState(m_state.form);
  renderTools();
  renderSignals();
}

void RigSetup::renderTools() {
  const bool busy = !m_state.busy.isEmpty();
  for (int i = 0; i < m_search.size(); ++i) {
    m_search[i]->setVisible(m_state.searches.contains(searchNames()[i]));
    m_search[i]->setEnabled(!busy);
  }
  m_test->setVisible(m_state.canTest);
  m_test->setEnabled(!busy);
  m_addSensors->setVisible(m_state.canAddSensors);
  m_preview->setVisible(m_state.isCamera);
  m_preview->setChecked(m_state.preview);
  m_cameraBox->setVisible(m_state.isCamera && m_state.preview);
  if (busy) {
    m_progress->setProgress(m_state.busy, m_state.fraction);
  } else {
    m_progress->clear();
  }
  const QString words = busy ? m_state.busy : m_state.result;
  m_result->setText(words);
  m_result->setVisible(!words.isEmpty());
  const char* role = m_state.resultJudgement == Judgement::bad  ? "bad"
                     : m_state.resultJudgement == Judgement::ok ? "ok"
                                                                : "muted";
  if (m_result->property("role") != QLatin1String(role)) {
    m_result->setProperty("role", role);
    m_result->setStyleSheet(QString());  // looks at the role again
  }
  QVector<QVector<DataCell>> rows;
  for (const FoundThing& thing : m_state.found) rows.append({{thing.what}, {thing.detail}});
  m_found->setColumns({{tr("Found"), 0, false, {}}, {tr("Detail"), 220, false, {}}});
  m_found->setRows(rows);
  m_found->setVisible(!rows.isEmpty());
}

void RigSetup::renderSignals() {
  m_signals->setDevices(m_state.devices);
  m_signals->setRows(m_state.lines);
  const int row = m_signals->currentRow();
  m_removeSensor->setEnabled(row >= 0 && row < m_state.lines.size() && m_state.lines[row].sensor);
  m_live->setEnabled(m_state.canLive || m_state.live);
  m_live->setChecked(m_state.live);
  const auto assigned = std::count_if(m_state.lines.begin(), m_state.lines.end(),
                                      [](const SignalLine& line) { return !line.signal.isEmpty(); });
  m_signalNote->setText(m_state.live ? tr("Warm one sensor with your hand: the right row must rise.")
                                     : tr("%n assigned", nullptr, static_cast<int>(assigned)));
}

void RigSetup::retranslate() {
  m_card->setTitle(tr("Rig"));
  m_view->setItems({tr("Devices and cameras"), tr("Signals")});
  m_undo->setText(tr("Undo"));
  m_undo->setToolTip(QKeySequence(QKeySequence::Undo).toString(QKeySequence::NativeText));
  m_redo->setText(tr("Redo"));
  m_redo->setToolTip(QKeySequence(QKeySequence::Redo).toString(QKeySequence::NativeText));
  const QStringList texts = {tr("Find ports"), tr("Find units"), tr("Find in the network"), tr("Find cameras")};
  const QStringList tips = {tr("Serial ports of this computer"),
                            tr("Asks each unit number from 1 to 247 on this port. It takes up to a minute."),
                            tr("Tries the ports 502 and 5000 at the addresses of this computer's own networks"),
                            tr("GigE Vision, USB3 Vision and devices of this computer")};
  for (int i = 0; i < m_search.size(); ++i) {
    m_search[i]->setText(texts[i]);
    m_search[i]->setToolTip(tips[i]);
  }
  m_test->setText(tr("Test"));
  m_test->setToolTip(tr("Connects and reads once"));
  m_addSensors->setText(tr("Add its sensors"));
  m_addSensors->setToolTip(tr("A temperature sensor for each channel that none reads yet"));
  m_preview->setText(tr("Preview"));
  m_camera->setPlaceholder(tr("No picture yet"));
  m_histogram->setAccessibleName(tr("Brightness of the pixels"));
  m_histogram->setToolTip(tr("Dark at the left, bright at the right; the last bar is saturated pixels"));
  m_addSensor->setText(tr("Add sensor"));
  m_removeSensor->setText(tr("Remove sensor"));
  m_live->setText(tr("Read live"));
  m_live->setToolTip(tr("Connects to the devices and reads once a second"));
  m_signals->retranslate();
  m_form->retranslate();
}

void RigSetup::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    retranslate();
    render();
    Q_EMIT languageChanged();
  }
  QWidget::changeEvent(event);
}

}  // namespace zerodrift::ui
