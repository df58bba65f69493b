// A subscriber to all topics of `pedicel SCENE --ros`, and a publisher of a joint trajectory, with
// Eclipse Cyclone DDS. Usage: cyclone_peer DOMAIN SECONDS JOINT POSITION
// The trajectory, which ends the scene's own program, is sent once something has happened, or after
// a while.
// Every line of standard output is "topic number words...": how many messages came, and of the last
// one what a test looks at. "tf_gap_us" is the longest simulated time between two messages of /tf
// (us), which is reliable: more than its period means that one was lost. "writer" and "reader" lines
// say what others offer, in the words of DDS: topic, type, reliability, durability, user data.
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "topics.h"

enum { topics = 16, longest = 400, most_endpoints = 300 };

struct topic {
  const char *name;
  const dds_topic_descriptor_t *type;
  bool reliable, latched;
  dds_entity_t reader;
  int count;
  char last[longest];
};

static double tf_before = -1.0, tf_gap = 0.0; /* s */

static double seconds(const builtin_interfaces_msg_dds__Time_ *t) { return t->sec + 1e-9 * t->nanosec; }

static void describe(struct topic *t, const void *sample) {
  char *out = t->last;
  if (t->type == &rosgraph_msgs_msg_dds__Clock__desc) {
    snprintf(out, longest, "%.9f", seconds(&((const rosgraph_msgs_msg_dds__Clock_ *)sample)->clock));
  } else if (t->type == &sensor_msgs_msg_dds__JointState__desc) {
    const sensor_msgs_msg_dds__JointState_ *s = sample;
    int n = snprintf(out, longest, "%.9f", seconds(&s->header.stamp));
    for (uint32_t i = 0; i < s->name._length && i < s->position._length && n < longest; ++i)
      n += snprintf(out + n, longest - n, " %s=%.6f", s->name._buffer[i], s->position._buffer[i]);
  } else if (t->type == &tf2_msgs_msg_dds__TFMessage__desc) {
    const tf2_msgs_msg_dds__TFMessage_ *s = sample;
    /* A camera's frame comes alone, between those of the rest: the rest is what a test looks at. */
    const bool alone = s->transforms._length == 1 && out[0] != '\0';
    int n = alone ? longest : snprintf(out, longest, "%u", s->transforms._length);
    if (!t->latched && s->transforms._length) {
      const double now = seconds(&s->transforms._buffer[0].header.stamp);
      if (tf_before >= 0.0 && now - tf_before > tf_gap) tf_gap = now - tf_before;
      tf_before = now;
    }
    for (uint32_t i = 0; i < s->transforms._length && n < longest; ++i)
      n += snprintf(out + n, longest - n, " %s", s->transforms._buffer[i].child_frame_id);
  } else if (t->type == &std_msgs_msg_dds__String__desc) {
    snprintf(out, longest, "%.300s", ((const std_msgs_msg_dds__String_ *)sample)->data);
    for (char *c = out; *c; ++c)
      if (*c == '\n') *c = ' ';
  } else if (t->type == &geometry_msgs_msg_dds__WrenchStamped__desc) {
    const geometry_msgs_msg_dds__WrenchStamped_ *s = sample;
    snprintf(out, longest, "%s %.6f %.6f %.6f", s->header.frame_id, s->wrench.force.x, s->wrench.force.y,
             s->wrench.force.z);
  } else if (t->type == &control_msgs_msg_dds__DynamicJointState__desc) {
    const control_msgs_msg_dds__DynamicJointState_ *s = sample;
    snprintf(out, longest, "%u %u", s->joint_names._length, s->interface_values._length);
  } else if (t->type == &sensor_msgs_msg_dds__Image__desc) {
    const sensor_msgs_msg_dds__Image_ *s = sample;
    snprintf(out, longest, "%s %ux%u %s %u", s->header.frame_id, s->width, s->height, s->encoding, s->data._length);
  } else if (t->type == &sensor_msgs_msg_dds__CameraInfo__desc) {
    const sensor_msgs_msg_dds__CameraInfo_ *s = sample;
    snprintf(out, longest, "%ux%u %.1f %.1f %s", s->width, s->height, s->k[2], s->p[6], s->distortion_model);
  } else if (t->type == &sensor_msgs_msg_dds__PointCloud2__desc) {
    const sensor_msgs_msg_dds__PointCloud2_ *s = sample;
    snprintf(out, longest, "%ux%u %u %u", s->width, s->height, s->fields._length, s->data._length);
  } else if (t->type == &visualization_msgs_msg_dds__MarkerArray__desc) {
    const visualization_msgs_msg_dds__MarkerArray_ *s = sample;
    snprintf(out, longest, "%u %s", s->markers._length, s->markers._length ? s->markers._buffer[0].ns : "");
  }
}

static void take(struct topic *t) {
  void *samples[1] = {NULL};
  dds_sample_info_t info[1];
  while (dds_take(t->reader, samples, info, 1, 1) > 0) {
    if (info[0].valid_data) {
      ++t->count;
      describe(t, samples[0]);
    }
    dds_return_loan(t->reader, samples, 1);
  }
}

static void send_trajectory(dds_entity_t writer, char *joint, double position) {
  trajectory_msgs_msg_dds__JointTrajectoryPoint_ point;
  trajectory_msgs_msg_dds__JointTrajectory_ message;
  memset(&point, 0, sizeof point);
  memset(&message, 0, sizeof message);
  point.positions._buffer = &position;
  point.positions._length = point.positions._maximum = 1;
  point.time_from_start.nanosec = 500000000;
  message.header.frame_id = "";
  message.joint_names._buffer = &joint;
  message.joint_names._length = message.joint_names._maximum = 1;
  message.points._buffer = &point;
  message.points._length = message.points._maximum = 1;
  if (dds_write(writer, &message) < 0) fprintf(stderr, "cannot write\n");
}

/* What discovery says of the others' writers or readers; our own have no user data. */
static void list_endpoints(dds_entity_t participant, dds_entity_t builtin, const char *kind) {
  static void *samples[most_endpoints];
  static dds_sample_info_t info[most_endpoints];
  const dds_entity_t reader = dds_create_reader(participant, builtin, NULL, NULL);
  memset(samples, 0, sizeof samples);
  const int n = dds_read(reader, samples, info, most_endpoints, most_endpoints);
  for (int i = 0; i < n; ++i) {
    const dds_builtintopic_endpoint_t *one = samples[i];
    dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
    dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
    dds_duration_t blocking;
    void *data = NULL;
    size_t size = 0;
    if (!info[i].valid_data || info[i].instance_state != DDS_IST_ALIVE) continue;
    dds_qget_reliability(one->qos, &reliability, &blocking);
    dds_qget_durability(one->qos, &durability);
    if (dds_qget_userdata(one->qos, &data, &size) && size > 0)
      printf("%s %s %s %s %s %.*s\n", kind, one->topic_name, one->type_name,
             reliability == DDS_RELIABILITY_RELIABLE ? "reliable" : "best_effort",
             durability == DDS_DURABILITY_VOLATILE ? "volatile" : "transient_local", (int)size,
             (const char *)data);
    dds_free(data);
  }
  if (n > 0) dds_return_loan(reader, samples, n);
}

int main(int argc, char **argv) {
  if (argc != 5) return 2;
  struct topic all[topics] = {
      {"rt/clock", &rosgraph_msgs_msg_dds__Clock__desc, false, false, 0, 0, ""},
      {"rt/joint_states", &sensor_msgs_msg_dds__JointState__desc, false, false, 0, 0, ""},
      {"rt/joint_commands", &sensor_msgs_msg_dds__JointState__desc, false, false, 0, 0, ""},
      {"rt/tf", &tf2_msgs_msg_dds__TFMessage__desc, true, false, 0, 0, ""},
      {"rt/tf_static", &tf2_msgs_msg_dds__TFMessage__desc, true, true, 0, 0, ""},
      {"rt/robot_description", &std_msgs_msg_dds__String__desc, true, true, 0, 0, ""},
      {"rt/wrist/wrench", &geometry_msgs_msg_dds__WrenchStamped__desc, false, false, 0, 0, ""},
      {"rt/pad/wrench", &geometry_msgs_msg_dds__WrenchStamped__desc, false, false, 0, 0, ""},
      {"rt/organ_forces", &control_msgs_msg_dds__DynamicJointState__desc, false, false, 0, 0, ""},
      {"rt/plant", &visualization_msgs_msg_dds__MarkerArray__desc, true, false, 0, 0, ""},
      {"rt/bodies", &visualization_msgs_msg_dds__MarkerArray__desc, true, false, 0, 0, ""},
      {"rt/events", &std_msgs_msg_dds__String__desc, true, false, 0, 0, ""},
      {"rt/top_view/image", &sensor_msgs_msg_dds__Image__desc, false, false, 0, 0, ""},
      {"rt/top_view/depth_image", &sensor_msgs_msg_dds__Image__desc, false, false, 0, 0, ""},
      {"rt/top_view/camera_info", &sensor_msgs_msg_dds__CameraInfo__desc, false, false, 0, 0, ""},
      {"rt/top_view/points", &sensor_msgs_msg_dds__PointCloud2__desc, false, false, 0, 0, ""}};
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) {
    fprintf(stderr, "no participant: %s\n", dds_strretcode(-participant));
    return 1;
  }
  for (int i = 0; i < topics; ++i) {
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, all[i].reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_MSECS(100));
    if (all[i].latched) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
    const dds_entity_t topic = dds_create_topic(participant, all[i].type, all[i].name, NULL, NULL);
    all[i].reader = dds_create_reader(participant, topic, qos, NULL);
    dds_delete_qos(qos);
    if (topic < 0 || all[i].reader < 0) {
      fprintf(stderr, "no reader of %s\n", all[i].name);
      return 1;
    }
  }
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  const dds_entity_t topic = dds_create_topic(participant, &trajectory_msgs_msg_dds__JointTrajectory__desc,
                                              "rt/joint_trajectory", NULL, NULL);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  bool sent = false;
  dds_time_t end = dds_time() + (dds_time_t)(atof(argv[2]) * 1e9);
  const dds_time_t patience = dds_time() + DDS_SECS(6);
  while (dds_time() < end) {
    for (int i = 0; i < topics; ++i) take(&all[i]);
    dds_publication_matched_status_t matched;
    dds_get_publication_matched_status(writer, &matched);
    bool happened = dds_time() > patience;
    for (int i = 0; i < topics; ++i)
      happened = happened || (all[i].count > 0 && strcmp(all[i].name, "rt/events") == 0);
    if (!sent && happened && matched.current_count > 0 && all[1].count > 0) {
      send_trajectory(writer, argv[3], atof(argv[4]));
      sent = true;
      /* Time to get there, also where the run is slow. */
      if (end < dds_time() + DDS_SECS(6)) end = dds_time() + DDS_SECS(6);
    }
    dds_sleepfor(DDS_MSECS(5));
  }
  for (int i = 0; i < topics; ++i) printf("%s %d %s\n", all[i].name + 2, all[i].count, all[i].last);
  printf("sent %d\n", sent);
  list_endpoints(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, "writer");
  list_endpoints(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, "reader");
  printf("tf_gap_us %.0f\n", tf_gap * 1e6);
  dds_delete(participant);
  return 0;
}
