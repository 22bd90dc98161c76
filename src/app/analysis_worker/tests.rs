use super::*;
use crate::app::read;
use crate::photo::ReadOptions;
use crate::view::Origin;

#[test]
fn a_cancellation_ends_the_requests_so_far_and_no_later_one() {
    let sample = Origin::Sample(crate::truth::sample::NAME.to_owned());
    let picture = Arc::new(read::picture(sample, ReadOptions::default()).unwrap());
    let request = |generation| AnalysisRequest {
        generation,
        picture: Arc::clone(&picture),
        params: Params::default(),
        area: None,
        tracing: Tracing::Never,
    };
    let latest_request = LatestRequest::default();
    latest_request.submit(request(1));
    let taken = latest_request.take().unwrap();
    assert_eq!(latest_request.interruption(taken.generation), None);
    latest_request.submit(request(2));
    assert_eq!(latest_request.interruption(1), Some(Interruption::Newer));
    latest_request.cancel(2);
    assert!(latest_request.is_quiet_for(Duration::ZERO), "the request that waited is canceled too");
    assert_eq!(latest_request.interruption(1), Some(Interruption::Stop));
    latest_request.submit(request(3));
    assert_eq!(
        latest_request.interruption(1),
        Some(Interruption::Stop),
        "at once, and not for the newer one"
    );
    assert_eq!(latest_request.take().unwrap().generation, 3);
    assert_eq!(latest_request.interruption(3), None);
    latest_request.close();
    assert_eq!(latest_request.interruption(3), Some(Interruption::Stop));
}

#[test]
fn a_canceled_analysis_ends_before_it_shows_a_stage() {
    let sample = Origin::Sample(crate::truth::sample::NAME.to_owned());
    let picture = Arc::new(read::picture(sample, ReadOptions::default()).unwrap());
    let mut worker = AnalysisWorker::default();
    let mut request = AnalysisRequest {
        generation: 1,
        picture,
        params: Params::default(),
        area: None,
        tracing: Tracing::Never,
    };
    assert!(worker.analyze(&request, &|_| {}, &|| None).is_some());
    request.params.camera_noise = crate::params::Setting::Value(4.0);
    assert!(worker.analyze(&request, &|_| {}, &|| Some(Interruption::Stop)).is_none());
}

#[test]
fn a_recording_reports_its_stages_and_an_interrupted_one_no_cursor() {
    let sample = Origin::Sample(crate::truth::sample::NAME.to_owned());
    let picture = Arc::new(read::picture(sample, ReadOptions::default()).unwrap());
    let (params, tracing) = (Params::default(), Tracing::AtRest);
    let request = AnalysisRequest { generation: 1, picture, params, area: None, tracing };
    let mut worker = AnalysisWorker::default();
    let shown = worker.analyze(&request, &|_| {}, &|| None).unwrap();
    let reports = Mutex::new(Vec::new());
    let send = |report| reports.lock().unwrap().push(report);
    let take = || std::mem::take(&mut *reports.lock().unwrap());
    worker.trace(&request, &shown, &send, &|| true);
    assert!(
        !take().iter().any(|report| matches!(report, Report::Traced { .. })) && shown.trace.get().is_none()
    );
    worker.trace(&request, &shown, &send, &|| false);
    let reports = take();
    let stages = reports.iter().filter(|report| matches!(report, Report::Recording { generation: 1, .. }));
    assert_eq!(stages.count(), Stage::ALL.len());
    assert!(matches!(reports.last(), Some(Report::Traced { generation: 1, .. })));
}
