// SPDX-License-Identifier: Apache-2.0
#include "tlm/payload_pool.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace payload_pool_test {

TEST(PayloadPool, APayloadIsReadyToSend) {
  PayloadPool pool(64);
  ::tlm::tlm_generic_payload& payload = pool.take(::tlm::TLM_WRITE_COMMAND, 0x1000, 48);
  EXPECT_TRUE(payload.is_write());
  EXPECT_EQ(payload.get_address(), 0x1000u);
  EXPECT_EQ(payload.get_data_length(), 48u);
  EXPECT_EQ(payload.get_streaming_width(), 48u);
  EXPECT_EQ(payload.get_byte_enable_ptr(), nullptr);
  EXPECT_EQ(payload.get_response_status(), ::tlm::TLM_INCOMPLETE_RESPONSE);
  EXPECT_EQ(payload.get_ref_count(), 1);
  payload.get_data_ptr()[63] = 1;  // the buffer is there
  payload.release();
}

TEST(PayloadPool, AReleasedPayloadIsUsedAgainAndForgetsItsPast) {
  PayloadPool pool(64);
  ::tlm::tlm_generic_payload& first = pool.take(::tlm::TLM_READ_COMMAND, 0, 64);
  first.set_response_status(::tlm::TLM_OK_RESPONSE);
  first.set_dmi_allowed(true);
  first.acquire();
  first.release();  // still held once
  ::tlm::tlm_generic_payload& second = pool.take(::tlm::TLM_READ_COMMAND, 0, 64);
  EXPECT_NE(&first, &second);
  EXPECT_NE(first.get_data_ptr(), second.get_data_ptr());
  first.release();
  ::tlm::tlm_generic_payload& third = pool.take(::tlm::TLM_WRITE_COMMAND, 8, 4);
  EXPECT_EQ(&first, &third);
  EXPECT_EQ(third.get_response_status(), ::tlm::TLM_INCOMPLETE_RESPONSE);
  EXPECT_FALSE(third.is_dmi_allowed());
  second.release();
  third.release();
}

TEST(PayloadPool, APayloadWithoutDataSaysSoUntilItIsUsedForSome) {
  PayloadPool pool(64);
  ::tlm::tlm_generic_payload& traffic = pool.take(::tlm::TLM_WRITE_COMMAND, 0, 64, false);
  EXPECT_NE(traffic.get_extension<TrafficOnly>(), nullptr);
  traffic.release();
  ::tlm::tlm_generic_payload& data = pool.take(::tlm::TLM_WRITE_COMMAND, 0, 64);
  EXPECT_EQ(&data, &traffic);
  EXPECT_EQ(data.get_extension<TrafficOnly>(), nullptr);
  data.release();
}

}  // namespace payload_pool_test
}  // namespace parallax
