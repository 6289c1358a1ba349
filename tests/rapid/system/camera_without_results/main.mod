! RAPID Instructions, CamReqImage: a camera that the station does not describe finds nothing, and the run says so.
MODULE camera_without_results
  PROC main()
    CamSetRunMode cam9;                     ! warning: R104 ! note: N214
    CamReqImage cam9;                       ! warning: R104
    TPWrite ValToStr(CamNumberOfResults(cam9)); ! -> 0 ! warning: R104
  ENDPROC
ENDMODULE
