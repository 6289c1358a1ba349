! Field practice, options: their data are known, whatever shape a site has given them.
MODULE data_of_options
  PERS spotdata spot1:=[1,1];
  PERS forcedata force1:=[2000,0.2,3,0];
  PERS sensor device:=[-1,-1,0];
  PERS partdata part1:=["weld_part","A part","T_ROB1:T_POS1",1,11,"",""];
  PERS ee_event event1:=[4,"prepare","T_ROB1:T_POS1",0,1];
  CONST be_scan scan1:=[2,8,8,45,35,25];
  CONST be_device device1:=["beam",TRUE,[6,45,100,100],[40,45,100,100],0.1,FALSE,TRUE,TRUE];
  CONST be_tooldesign design1:=[TRUE,30,18,50,6,6,TRUE,TRUE,1.2,[150,120],[250,150]];
  TASK PERS menudata menu:=["Home","","go_home",1,"",255,TRUE,1,0,FALSE,210];

  PROC main()
    TPWrite menu.description;               ! -> Home
    TPWrite ValToStr(device.state=STATE_UNDEFINED); ! -> TRUE
    SiConnect device;                       ! warning: R104
    SkipWarn;
    Linked_m_exe;
  ENDPROC
ENDMODULE
