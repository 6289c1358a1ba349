! RAPID Instructions, PackRawBytes: bytes of numbers and texts, and how far a container goes.
MODULE raw_bytes
  PROC main()
    VAR rawbytes r;
    VAR rawbytes r2;
    VAR num n;
    VAR byte b;
    VAR string s;
    VAR num f;
    ClearRawBytes r;
    TPWrite ValToStr(RawBytesLen(r));       ! -> 0
    PackRawBytes 8,r,RawBytesLen(r)+1\IntX:=INT;
    TPWrite ValToStr(RawBytesLen(r));       ! -> 2
    PackRawBytes 13.4,r,RawBytesLen(r)+1\Float4;
    PackRawBytes "abc",r,RawBytesLen(r)+1\ASCII;
    PackRawBytes 255,r,RawBytesLen(r)+1\Hex1;
    TPWrite ValToStr(RawBytesLen(r));       ! -> 10
    UnpackRawBytes r,1,n\IntX:=INT;
    TPWrite ValToStr(n);                    ! -> 8
    UnpackRawBytes r,3,f\Float4;
    TPWrite ValToStr(f);                    ! -> 13.4
    UnpackRawBytes r,7,s\ASCII:=3;
    TPWrite s;                              ! -> abc
    UnpackRawBytes r,10,b\Hex1;
    TPWrite ValToStr(b);                    ! -> 255
    UnpackRawBytes r,1,b\Hex1;
    UnpackRawBytes r\Network,1,n\IntX:=UINT;
    TPWrite ValToStr(b)+" "+ValToStr(n);    ! -> 8 2048
    CopyRawBytes r,7,r2,1\NoOfBytes:=3;
    TPWrite ValToStr(RawBytesLen(r2));      ! -> 3
    ClearRawBytes r\FromIndex:=7;
    TPWrite ValToStr(RawBytesLen(r));       ! -> 6
    UnpackRawBytes r,7,b\Hex1;
    UnpackRawBytes r,4,s\ASCII:=10;
    PackRawBytes 1,r,1030\Hex1;
    TPWrite "end";                          ! -> end
  ERROR
    IF ERRNO=ERR_ARGVALERR TPWrite "value"; ! -> value ! -> value ! -> value
    TRYNEXT;
  ENDPROC
ENDMODULE
