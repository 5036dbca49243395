// A circuit of one's own with pins, between two streams.
#include <cstdint>
#include <cstdio>
#include <systemc>

#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

// One register, AXI4-Stream on both sides.
class Invert final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> aclk{"aclk"}, aresetn{"aresetn"};
  sc_core::sc_in<std::uint32_t> s_axis_tdata{"s_axis_tdata"};
  sc_core::sc_in<bool> s_axis_tvalid{"s_axis_tvalid"}, m_axis_tready{"m_axis_tready"};
  sc_core::sc_out<std::uint32_t> m_axis_tdata{"m_axis_tdata"};
  sc_core::sc_out<bool> m_axis_tvalid{"m_axis_tvalid"}, s_axis_tready{"s_axis_tready"};

  explicit Invert(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Invert);
    SC_METHOD(edge);
    sensitive << aclk.pos();
    dont_initialize();
    SC_METHOD(ready);
    sensitive << m_axis_tvalid << m_axis_tready;
  }

 private:
  void edge() {
    if (s_axis_tready) m_axis_tdata = 255 - s_axis_tdata;
    m_axis_tvalid = aresetn && (s_axis_tready ? s_axis_tvalid : m_axis_tvalid);
  }
  void ready() { s_axis_tready = !m_axis_tvalid || m_axis_tready; }
};

// What is before and behind it: threads here; stages and DMA engines are connected likewise.
class Ends final : public sc_core::sc_module {
 public:
  parallax::StreamOut<std::uint8_t> to{"to"};
  parallax::StreamIn<std::uint8_t> from{"from"};
  bool right = true;

  explicit Ends(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Ends);
    SC_THREAD(write);
    SC_THREAD(read);
  }

 private:
  void write() {
    for (std::uint8_t i = 0; i < 100; ++i) to.write(i);
  }
  void read() {
    for (int i = 0; i < 100; ++i) right &= from.read() == 255 - i;
    sc_core::sc_stop();
  }
};

int sc_main(int, char**) {
  const parallax::ClockDomain core("core", parallax::Hertz(100'000'000));
  parallax::Dataflow dataflow("dataflow");
  const parallax::FifoConfig fifo;  // two tokens deep, registered
  parallax::Stream<std::uint8_t> before("before", dataflow, core, core, fifo);
  parallax::Stream<std::uint8_t> behind("behind", dataflow, core, core, fifo);
  Ends ends("ends");
  ends.to(before);
  ends.from(behind);

  parallax::PinClockConfig reset;
  reset.reset_is_low = true;
  parallax::PinClock clock("clock", core, reset);
  parallax::PinSource<std::uint8_t, std::uint32_t> source("source", clock);
  parallax::PinSink<std::uint8_t, std::uint32_t> sink("sink", clock);
  Invert circuit("circuit");
  sc_core::sc_signal<bool> aclk, aresetn;
  parallax::PinSignals<std::uint32_t> s_axis, m_axis;  // data, valid and ready
  clock.clock(aclk);
  clock.reset(aresetn);
  circuit.aclk(aclk);
  circuit.aresetn(aresetn);
  source.in(before);
  source.bind(s_axis);
  circuit.s_axis_tdata(s_axis.data);
  circuit.s_axis_tvalid(s_axis.valid);
  circuit.s_axis_tready(s_axis.ready);
  sink.out(behind);
  sink.bind(m_axis);
  circuit.m_axis_tdata(m_axis.data);
  circuit.m_axis_tvalid(m_axis.valid);
  circuit.m_axis_tready(m_axis.ready);

  sc_core::sc_start();
  const std::int64_t last = core.now().count();  // 99, and a cycle in each FIFO and in the circuit
  std::printf("100 tokens, the last one in cycle %lld\n", static_cast<long long>(last));
  return ends.right && last == 102 ? 0 : 1;
}
