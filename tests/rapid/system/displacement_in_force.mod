! RAPID Data types, progdisp: C_PROGDISP tells the displacement that is in force.
MODULE displacement_in_force
  PROC main()
    TPWrite ValToStr(C_PROGDISP.pdisp);     ! -> [[0,0,0],[1,0,0,0]]
    PDispSet [[10,20,30],[1,0,0,0]];
    TPWrite ValToStr(C_PROGDISP.pdisp.trans); ! -> [10,20,30]
    EOffsSet [5,0,0,0,0,0];
    TPWrite ValToStr(C_PROGDISP.eoffs);     ! -> [5,0,0,0,0,0]
    PDispOff;
    TPWrite ValToStr(C_PROGDISP.pdisp.trans); ! -> [0,0,0]
  ENDPROC
ENDMODULE
