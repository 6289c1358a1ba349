! Field practice, options: their data are known, whatever shape a site has given them.
MODULE data_of_options
  PERS spotdata spot1:=[1,1];
  PERS forcedata force1:=[2000,0.2,3,0];
  PERS sensor device:=[-1,-1,0];
  TASK PERS menudata menu:=["Home","","go_home",1,"",255,TRUE,1,0,FALSE,210];

  PROC main()
    TPWrite menu.description;                      ! -> Home
    TPWrite ValToStr(device.state=STATE_UNDEFINED); ! -> TRUE
    SiConnect device;                       ! warning: R104
    SkipWarn;
    Linked_m_exe;
  ENDPROC
ENDMODULE
